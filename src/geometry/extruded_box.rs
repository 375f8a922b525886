//! The shadow volume of a box, as far as an eye outside of it sees its surface.
//!
//! All that a box contains casts its shadow within that of the box (Stich, Wächter and Keller 2007, section 11.3.3). This
//! volume is convex: the faces that the light sees, the light planes through the edges where these end, and what is
//! beyond the scene, which no eye in the scene sees from outside.

use super::{Bounds, EndPlanes};
use glam::{DVec3, DVec4};

/// Corners of a box by number: bits for x, y and z, 1 at the larger end. Each face counter-clockwise seen from outside.
const FACES: [[usize; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// Ends of each edge, and the faces on either side of it.
const EDGES: [([usize; 2], [usize; 2]); 12] = [
    ([0, 1], [2, 4]),
    ([2, 3], [3, 4]),
    ([4, 5], [2, 5]),
    ([6, 7], [3, 5]),
    ([0, 2], [0, 4]),
    ([1, 3], [1, 4]),
    ([4, 6], [0, 5]),
    ([5, 7], [1, 5]),
    ([0, 4], [0, 2]),
    ([1, 5], [1, 2]),
    ([2, 6], [0, 3]),
    ([3, 7], [1, 3]),
];

/// The faces of boxes that can be seen, as lists of triangles.
#[derive(Debug, Clone, Default)]
pub struct VisibleFaces {
    /// Homogeneous corners, three a triangle.
    pub corners: Vec<[f32; 4]>,
    /// Where the corners of each box end.
    pub ends: Vec<u32>,
}

impl VisibleFaces {
    /// No box any more.
    pub fn clear(&mut self) {
        self.corners.clear();
        self.ends.clear();
    }

    /// Adds a box itself, seen from an eye outside of it.
    pub fn push_box(&mut self, bounds: Bounds, eye: DVec3) {
        let corners = corners(bounds);
        for face in FACES {
            if is_before(face, &corners, eye.extend(1.0)) {
                self.quad(face.map(|corner| corners[corner].extend(1.0)));
            }
        }
        self.ends.push(self.corners.len() as u32);
    }

    /// Adds the shadow volume of a box, which the light, and the eye to which its faces are turned, are outside of.
    pub fn push_volume(
        &mut self,
        bounds: Bounds,
        light: DVec4,
        end_planes: &EndPlanes,
        eye: DVec3,
    ) {
        let corners = corners(bounds);
        let plane = end_planes.coefficients()[end_planes.of(bounds).index()].as_dvec4();
        let far = |p: DVec3| plane.dot(light) * p.extend(1.0) - plane.dot(p.extend(1.0)) * light;
        let is_lit = FACES.map(|face| is_before(face, &corners, light));
        for (face, is_lit) in FACES.into_iter().zip(is_lit) {
            if is_lit && is_before(face, &corners, eye.extend(1.0)) {
                self.quad(face.map(|corner| corners[corner].extend(1.0)));
            }
        }
        let middle = (bounds.low + bounds.high) / 2.0;
        for (ends, [one, other]) in EDGES {
            if is_lit[one] == is_lit[other] {
                continue;
            }
            let [a, b] = ends.map(|corner| corners[corner]);
            let normal = (b - a).cross(light.truncate() - a * light.w);
            // Seen from outside unless it is on the same side of the plane as the box.
            if normal.dot(middle - a) * normal.dot(eye - a) <= 0.0 {
                self.quad([a.extend(1.0), b.extend(1.0), far(b), far(a)]);
            }
        }
        self.ends.push(self.corners.len() as u32);
    }

    fn quad(&mut self, [a, b, c, d]: [DVec4; 4]) {
        let corners = [a, b, c, a, c, d].map(|corner| {
            // A point that is far away, or a direction, in numbers that 32 bits hold.
            let size = match corner.w {
                0.0 => corner.truncate().abs().max_element(),
                w => w,
            };
            (corner / size).as_vec4().to_array()
        });
        self.corners.extend(corners);
    }
}

fn corners(bounds: Bounds) -> [DVec3; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|corner: usize| {
        let at = |bit: usize, low: f64, high: f64| if corner >> bit & 1 == 0 { low } else { high };
        DVec3::new(
            at(0, bounds.low.x, bounds.high.x),
            at(1, bounds.low.y, bounds.high.y),
            at(2, bounds.low.z, bounds.high.z),
        )
    })
}

/// Whether a point (w = 1) or a direction (w = 0) is before a face of a box.
fn is_before([a, b, _, d]: [usize; 4], corners: &[DVec3; 8], at: DVec4) -> bool {
    let [a, b, d] = [a, b, d].map(|corner| corners[corner]);
    let normal = (b - a).cross(d - a);
    normal.dot(at.truncate() - a * at.w) > 0.0
}

#[cfg(test)]
#[path = "extruded_box_tests.rs"]
mod tests;
