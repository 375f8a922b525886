//! Closed shapes of buildings.

use crate::scene::part::Part;
use glam::{Vec2, Vec3};

/// How deep walls go below the ground, in metres, so that no floor lies in it.
const FOUNDATION_M: f32 = 0.5;

/// Height of a storey in metres.
pub(super) const STOREY_M: f32 = 3.5;

/// How far a ledge stands out, and how high it is, in metres.
const LEDGE_M: [f32; 2] = [0.25, 0.3];

/// A level outline at a height, moved outwards by so many metres at corners of a square.
#[derive(Clone, Copy)]
struct Ring {
    y: f32,
    out: f32,
}

/// A shape under construction.
#[derive(Default)]
struct Shape {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

/// A convex outline, counter-clockwise seen from above: x, z.
pub(super) type Outline = Vec<Vec2>;

/// A rectangle about a point.
pub(super) fn rectangle(middle: Vec2, size: Vec2) -> Outline {
    [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)]
        .map(|(x, z)| middle + size / 2.0 * Vec2::new(x, z))
        .to_vec()
}

/// An even polygon about a point.
pub(super) fn polygon(middle: Vec2, radius: f32, sides: u32, turn: f32) -> Outline {
    let corner = |side: u32| {
        let (sin, cos) = (turn + std::f32::consts::TAU * side as f32 / sides as f32).sin_cos();
        middle + radius * Vec2::new(cos, -sin)
    };
    (0..sides).map(corner).collect()
}

/// A building with a flat roof: walls with ledges up to `height`, and on it narrower ones, each `[height, part]` of the outline
/// below.
pub(super) fn tower(name: &str, outline: &Outline, tiers: &[[f32; 2]], ledges: u32) -> Part {
    let mut shape = Shape::default();
    let middle = centre(outline);
    let mut size = 1.0;
    let mut bottom = -FOUNDATION_M;
    let mut rings = Vec::new();
    for &[top, part] in tiers {
        size *= part;
        let scaled: Outline = outline
            .iter()
            .map(|p| middle + (*p - middle) * size)
            .collect();
        for ring in wall(bottom, top, ledges) {
            rings.push(shape.ring(&scaled, ring));
        }
        bottom = top;
    }
    for pair in rings.windows(2) {
        shape.walls(pair[0], pair[1], outline.len() as u32);
    }
    shape.close(&rings, outline.len() as u32);
    shape.part(name)
}

/// A building under a gable roof, whose ridge goes along the first side.
pub(super) fn house(name: &str, outline: &Outline, height: f32, roof: f32, ledges: u32) -> Part {
    let mut shape = Shape::default();
    let rings: Vec<u32> = wall(-FOUNDATION_M, height, ledges)
        .into_iter()
        .map(|ring| shape.ring(outline, ring))
        .collect();
    for pair in rings.windows(2) {
        shape.walls(pair[0], pair[1], 4);
    }
    let (bottom, top) = (rings[0], rings[rings.len() - 1]);
    let ridge = |a: usize, b: usize| {
        let between = (outline[a] + outline[b]) / 2.0;
        Vec3::new(between.x, height + roof, between.y)
    };
    let [left, right] = [ridge(3, 0), ridge(1, 2)].map(|p| shape.vertex(p));
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| top + corner);
    shape.triangles.extend([
        [a, b, right],
        [a, right, left],
        [c, d, left],
        [c, left, right],
        [b, c, right],
        [d, a, left],
        [bottom, bottom + 2, bottom + 1],
        [bottom, bottom + 3, bottom + 2],
    ]);
    shape.part(name)
}

/// A building around a courtyard, with a flat roof.
pub(super) fn courtyard(
    name: &str,
    [outer, inner]: [&Outline; 2],
    height: f32,
    ledges: u32,
) -> Part {
    let mut shape = Shape::default();
    let corners = outer.len() as u32;
    let outside: Vec<u32> = wall(-FOUNDATION_M, height, ledges)
        .into_iter()
        .map(|ring| shape.ring(outer, ring))
        .collect();
    let inside = [-FOUNDATION_M, height].map(|y| shape.ring(inner, Ring { y, out: 0.0 }));
    for pair in outside.windows(2) {
        shape.walls(pair[0], pair[1], corners);
    }
    // Seen from the yard: from top to bottom.
    shape.walls(inside[1], inside[0], corners);
    shape.walls(outside[outside.len() - 1], inside[1], corners);
    shape.walls(inside[0], outside[0], corners);
    shape.part(name)
}

fn centre(outline: &Outline) -> Vec2 {
    outline.iter().sum::<Vec2>() / outline.len() as f32
}

/// The outlines of a wall from bottom to top.
fn wall(bottom: f32, top: f32, ledges: u32) -> Vec<Ring> {
    let plain = |y: f32| Ring { y, out: 0.0 };
    let [out, high] = LEDGE_M;
    let mut rings = vec![plain(bottom)];
    let step = STOREY_M / ledges.max(1) as f32;
    let high = high.min(step / 2.0);
    let mut y = bottom.max(0.0) + step;
    while ledges > 0 && y + high < top {
        rings.extend([
            plain(y - high),
            Ring { y: y - high, out },
            Ring { y, out },
            plain(y),
        ]);
        y += step;
    }
    rings.push(plain(top));
    rings
}

impl Shape {
    fn vertex(&mut self, position: Vec3) -> u32 {
        self.positions.push(position);
        self.positions.len() as u32 - 1
    }

    /// Gives the first of its vertices.
    fn ring(&mut self, outline: &Outline, ring: Ring) -> u32 {
        let first = self.positions.len() as u32;
        let middle = centre(outline);
        for corner in outline {
            let away = *corner - middle;
            let at = *corner + ring.out * std::f32::consts::SQRT_2 * away.normalize_or_zero();
            self.vertex(Vec3::new(at.x, ring.y, at.y));
        }
        first
    }

    /// Between two rings, the first below the second seen from outside.
    fn walls(&mut self, below: u32, above: u32, corners: u32) {
        for corner in 0..corners {
            let next = (corner + 1) % corners;
            let [a, b] = [below + corner, below + next];
            let [c, d] = [above + next, above + corner];
            self.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }

    /// A floor under the first ring and a roof over the last.
    fn close(&mut self, rings: &[u32], corners: u32) {
        let (bottom, top) = (rings[0], rings[rings.len() - 1]);
        for corner in 1..corners - 1 {
            self.triangles.push([top, top + corner, top + corner + 1]);
            self.triangles
                .push([bottom, bottom + corner + 1, bottom + corner]);
        }
    }

    fn part(self, name: &str) -> Part {
        Part::new(name, &self.positions, self.triangles)
    }
}
