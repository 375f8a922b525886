//! Polygons of any shape become triangles between their own corners.
//!
//! A polygon of n corners makes n - 2 triangles, whatever its shape, and a few more only where a side of it runs
//! through another of its corners. They do not depend on the corner with which the polygon begins, nor on the
//! way it runs around: it is first turned so that it begins and runs like all its spellings.

use std::cmp::Ordering;
use std::collections::HashMap;

use glam::{DVec3, Vec3};
use spade::handles::FixedFaceHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// A polygon is flat if its corners are no farther from one plane than this part of its size.
const FLAT: f64 = 1e-3;

/// How far the rounding of coordinates may move a corner, as a part of the largest coordinate.
const ROUNDING: f64 = 4.0 / (1 << 24) as f64;

/// What the triangles of a polygon leave to say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// Nothing: they are what the polygon is.
    Flat,
    /// Its corners lie in no plane, and other triangles would have another shape. How far they are from
    /// the best plane, as a part of the polygon's size.
    Bent(f64),
    /// Seen along the normal of its best plane it crosses itself, so that it has no inside.
    Crossing,
}

/// Appends the triangles of a polygon of at least three corners, given as indices into `positions`, which
/// are [canonical](super::mesh::canonical).
pub(super) fn triangulate(
    corners: &[u32],
    positions: &[Vec3],
    triangles: &mut Vec<[u32; 3]>,
) -> Shape {
    if let &[a, b, c] = corners {
        triangles.push([a, b, c]);
        return Shape::Flat;
    }
    let at = |corner: u32| positions[corner as usize];
    let (corners, reversed) = turned(corners, at);
    let points: Vec<Vec3> = corners.iter().map(|corner| at(*corner)).collect();
    let mut shape = Shape::Flat;
    let chosen = match Plane::of(&points) {
        // Nothing to see: any triangles will do.
        None => fan(points.len()),
        Some(plane) => {
            shape = plane.shape(&points);
            let projected: Vec<_> = points.iter().map(|p| plane.project(*p)).collect();
            quad(&points, &projected)
                .or_else(|| inside(&points, &projected))
                .unwrap_or_else(|| {
                    shape = Shape::Crossing;
                    fan(points.len())
                })
        }
    };
    triangles.extend(chosen.into_iter().map(|[a, b, c]| {
        let [a, b, c] = [a, b, c].map(|corner| corners[corner]);
        if reversed { [a, c, b] } else { [a, b, c] }
    }));
    shape
}

/// The polygon from that corner and in that direction from which its positions come first in their order,
/// and whether that is against its own direction.
fn turned(corners: &[u32], at: impl Fn(u32) -> Vec3) -> (Vec<u32>, bool) {
    let mut forwards = corners.to_vec();
    let mut backwards: Vec<u32> = corners.iter().rev().copied().collect();
    for direction in [&mut forwards, &mut backwards] {
        let first = least_rotation(direction, &at);
        direction.rotate_left(first);
    }
    let pairs = forwards.iter().zip(&backwards);
    let order = pairs.map(|(one, other)| by_place(at(*one), at(*other)));
    match order.into_iter().find(|order| order.is_ne()) {
        Some(Ordering::Greater) => (backwards, true),
        _ => (forwards, false),
    }
}

fn by_place(one: Vec3, other: Vec3) -> Ordering {
    let [one, other] = [one, other].map(|p| p.to_array());
    one.partial_cmp(&other).unwrap_or(Ordering::Equal)
}

/// Where the rotation begins whose positions come first. Two candidates run against each other; the one that
/// loses skips all that it had in common, so that this takes linear time.
fn least_rotation(corners: &[u32], at: impl Fn(u32) -> Vec3) -> usize {
    let count = corners.len();
    let place = |i: usize| at(corners[i % count]);
    let (mut one, mut other, mut common) = (0, 1, 0);
    while one < count && other < count && common < count {
        match by_place(place(one + common), place(other + common)) {
            Ordering::Equal => {
                common += 1;
                continue;
            }
            Ordering::Greater => one += common + 1,
            Ordering::Less => other += common + 1,
        }
        other += usize::from(one == other);
        common = 0;
    }
    one.min(other)
}

/// The best plane of a polygon.
struct Plane {
    /// Of length 1.
    normal: DVec3,
    middle: DVec3,
    /// Of the polygon: the longest distance from its first corner.
    size: f64,
    /// How far rounding may have moved a corner along each axis: not at all where all have one coordinate.
    rounding: DVec3,
}

impl Plane {
    /// `None` if the corners lie on a line.
    fn of(points: &[Vec3]) -> Option<Self> {
        let from_first = |p: &Vec3| p.as_dvec3() - points[0].as_dvec3();
        let farthest = points.iter().map(from_first);
        let axis = farthest.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
        let size = axis.length();
        let largest = points.iter().fold(Vec3::ZERO, |most, p| most.max(p.abs()));
        let varies = points
            .iter()
            .fold(Vec3::ZERO, |most, p| most.max((*p - points[0]).abs()));
        let varies = varies.cmpgt(Vec3::ZERO);
        let rounding = ROUNDING * Vec3::select(varies, largest, Vec3::ZERO).as_dvec3();
        let direction = axis.try_normalize()?;
        let across = points.iter().map(|p| direction.cross(from_first(p)));
        let widest = across.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?;
        let widthwise = widest.cross(direction).normalize_or_zero();
        if widest.length() <= widthwise.abs().dot(rounding).max(1e-7 * size) {
            return None;
        }
        // Newell: twice the areas of the polygon's projections.
        let next = points.iter().cycle().skip(1);
        let area: DVec3 = points
            .iter()
            .zip(next)
            .map(|(p, q)| from_first(p).cross(from_first(q)))
            .sum();
        let is_none = area.length() <= 1e-9 * size * widest.length();
        Some(Self {
            // Its halves cancel: it crosses itself, in one plane or another.
            normal: if is_none { widest } else { area }.normalize(),
            middle: points[0].as_dvec3()
                + points.iter().map(from_first).sum::<DVec3>() / points.len() as f64,
            size,
            rounding,
        })
    }

    fn shape(&self, points: &[Vec3]) -> Shape {
        let height = |p: &Vec3| self.normal.dot(p.as_dvec3() - self.middle).abs();
        let highest = points.iter().map(height).fold(0.0, f64::max);
        if highest <= FLAT * self.size + self.normal.abs().dot(self.rounding) {
            Shape::Flat
        } else {
            Shape::Bent(highest / self.size)
        }
    }

    /// Along the axis that is nearest to the normal, so that nothing is rounded; a polygon with this normal
    /// runs counter-clockwise.
    fn project(&self, p: Vec3) -> Point2<f64> {
        let p = p.as_dvec3();
        let normal = self.normal.abs();
        let (component, [u, v]) = if normal.x >= normal.y && normal.x >= normal.z {
            (self.normal.x, [p.y, p.z])
        } else if normal.y >= normal.z {
            (self.normal.y, [p.z, p.x])
        } else {
            (self.normal.z, [p.x, p.y])
        };
        if component < 0.0 {
            Point2::new(v, u)
        } else {
            Point2::new(u, v)
        }
    }
}

fn fan(count: usize) -> Vec<[usize; 3]> {
    (1..count - 1).map(|i| [0, i, i + 1]).collect()
}

/// A quad along the shorter of the diagonals that are inside. `None` for other polygons, and where it is too
/// close to call.
fn quad(points: &[Vec3], projected: &[Point2<f64>]) -> Option<Vec<[usize; 3]>> {
    if points.len() != 4 {
        return None;
    }
    let is_left_turn = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [a, b, c].map(|corner| projected[corner]);
        let left = (b.x - a.x) * (c.y - a.y);
        let right = (b.y - a.y) * (c.x - a.x);
        left - right > 1e-12 * (left.abs() + right.abs())
    };
    let along = |start: usize| {
        let triangles = [0, 1].map(|i| [0, i + 1, i + 2].map(|corner| (start + corner) % 4));
        let length = points[start]
            .as_dvec3()
            .distance_squared(points[start + 2].as_dvec3());
        triangles
            .into_iter()
            .all(is_left_turn)
            .then_some((length, triangles))
    };
    let [first, second] = [along(0), along(1)];
    let (_, triangles) = match (first, second) {
        (Some(first), Some(second)) => Some(if second.0 < first.0 { second } else { first }),
        (first, second) => first.or(second),
    }?;
    Some(triangles.to_vec())
}

/// The triangles of a constrained Delaunay triangulation that lie inside, and as many without area as are
/// missing. `None` if the polygon crosses itself.
fn inside(points: &[Vec3], projected: &[Point2<f64>]) -> Option<Vec<[usize; 3]>> {
    let count = points.len();
    let mut vertex_at = HashMap::with_capacity(count);
    let mut corner_of = Vec::with_capacity(count);
    let mut vertices = Vec::with_capacity(count);
    for (corner, place) in projected.iter().enumerate() {
        let bits = [place.x, place.y].map(f64::to_bits);
        let vertex = *vertex_at.entry(bits).or_insert(corner_of.len());
        match corner_of.get(vertex) {
            None => corner_of.push(corner),
            // Two places become one: not what the polygon is.
            Some(&other) if points[other] != points[corner] => return None,
            // The polygon comes back to a corner, as where a bridge leads to a hole in it.
            Some(_) => {}
        }
        vertices.push(vertex);
    }
    let places = corner_of.iter().map(|corner| projected[*corner]).collect();
    // All at once: one by one, corners on a line take time by all before.
    let mut delaunay =
        ConstrainedDelaunayTriangulation::<Point2<f64>>::bulk_load_cdt(places, Vec::new()).ok()?;
    let handles: Vec<_> = delaunay.fixed_vertices().collect();
    // How often the polygon runs along an edge from its smaller vertex to its larger one, less how often
    // the other way.
    let mut runs: HashMap<[usize; 2], i32> = HashMap::with_capacity(count);
    for (i, &from) in vertices.iter().enumerate() {
        let to = vertices[(i + 1) % count];
        if from == to {
            continue;
        }
        let edges = delaunay.try_add_constraint(handles[from], handles[to]);
        if edges.is_empty() {
            return None;
        }
        for edge in edges {
            let [a, b] = delaunay.directed_edge(edge).vertices().map(|v| v.index());
            *runs.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
        }
    }
    let windings = windings(&delaunay, &runs);
    let mut triangles = Vec::with_capacity(count - 2);
    for face in delaunay.inner_faces() {
        let [a, b, c] = face.vertices().map(|v| corner_of[v.index()]);
        match windings[face.index()] {
            0 => {}
            1 => triangles.push([a, b, c]),
            -1 => triangles.push([a, c, b]),
            _ => return None,
        }
    }
    triangles.resize(triangles.len().max(count - 2), [0; 3]);
    Some(triangles)
}

/// How often the polygon runs around each face, counter-clockwise.
fn windings(
    delaunay: &ConstrainedDelaunayTriangulation<Point2<f64>>,
    runs: &HashMap<[usize; 2], i32>,
) -> Vec<i32> {
    let mut windings = vec![None; delaunay.num_all_faces()];
    let outer: FixedFaceHandle<_> = delaunay.outer_face().fix();
    windings[outer.index()] = Some(0);
    // From the hull inwards: the outer face has an edge to each of its neighbours.
    let mut open: Vec<_> = delaunay.convex_hull().map(|edge| edge.fix()).collect();
    while let Some(edge) = open.pop() {
        // This face is known, the one on the other side may not be.
        let edge = delaunay.directed_edge(edge);
        let beyond = edge.rev();
        let known = windings[edge.face().fix().index()].unwrap_or_default();
        if windings[beyond.face().fix().index()].is_some() {
            continue;
        }
        let [a, b] = beyond.vertices().map(|v| v.index());
        let along = runs.get(&[a.min(b), a.max(b)]).copied().unwrap_or_default();
        // On the left of an edge the polygon runs around once more than on its right.
        windings[beyond.face().fix().index()] = Some(known + if a < b { along } else { -along });
        let mut around = beyond.next();
        while around.fix() != beyond.fix() {
            open.push(around.fix());
            around = around.next();
        }
    }
    windings
        .into_iter()
        .map(Option::unwrap_or_default)
        .collect()
}

#[cfg(test)]
#[path = "polygon_tests.rs"]
mod tests;
