//! A triangle as rays are held against it.

use crate::geometry::vertex_less;
use crate::scene::Mesh;
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec3A};
use obvhs::aabb::Aabb;

/// Half the last bit of 1: what one operation may be off by, as a part of its result.
pub(super) const ROUNDING: f32 = 1.0 / (1 << 24) as f32;

/// A triangle, its corners in the vertex order.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct RayTriangle {
    /// The smallest corner.
    pub a: Vec3,
    /// Its number in the scene.
    pub number: u32,
    /// The middle one.
    pub b: Vec3,
    /// What rounding may do to a distance from its plane, near it, times twice its area.
    pub contact: f32,
    /// The largest one.
    pub c: Vec3,
    /// Twice its area.
    pub double_area: f32,
}

impl RayTriangle {
    /// One of a mesh.
    pub(super) fn new(mesh: &Mesh, number: u32) -> Self {
        let corners = mesh.triangles[number as usize].map(|vertex| mesh.positions[vertex as usize]);
        let [a, b, c] = in_order(corners);
        let (contact, double_area) = contact([a, b, c]);
        Self {
            a,
            number,
            b,
            contact,
            c,
            double_area,
        }
    }

    /// Its corners.
    #[inline(always)]
    pub fn corners(&self) -> [Vec3; 3] {
        [self.a, self.b, self.c]
    }

    /// A box around it, larger by a margin.
    pub(super) fn bounds(&self, margin: f32) -> Aabb {
        let bounds = Aabb::from_points(&self.corners().map(Vec3A::from));
        Aabb::new(bounds.min - margin, bounds.max + margin)
    }
}

/// The normal of a triangle, times twice its area: from its two shorter sides, which of a needle too are hardly longer than
/// it asks for.
#[inline(always)]
pub(super) fn normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let (of_ab, of_bc, of_ca) = (
        ab.length_squared(),
        bc.length_squared(),
        ca.length_squared(),
    );
    if of_ab >= of_bc.max(of_ca) {
        cross(bc, ca)
    } else if of_bc >= of_ca {
        cross(ca, ab)
    } else {
        cross(ab, bc)
    }
}

/// What roundings do to a point's distance from a triangle's plane if it is within its light planes and near it, times
/// twice the triangle's area; and that.
///
/// Such a point is no farther from the first corner than the longest side. Rounding moves the vector from there to the point
/// twice and their product with the normal three times, each as a part of the normal, and the normal four times as a part of
/// the product of the shorter sides.
fn contact(corners: [Vec3; 3]) -> (f32, f32) {
    // Products of large coordinates would overflow.
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let mut sides = [b - a, c - b, a - c].map(glam::DVec3::length);
    sides.sort_unstable_by(f64::total_cmp);
    let double_area = (b - a).cross(c - a).length();
    let roundings = 5.0 * double_area + 4.0 * sides[0] * sides[1];
    let contact = f64::from(ROUNDING) * sides[2] * roundings;
    (contact as f32, double_area as f32)
}

/// Corners in the vertex order.
fn in_order([mut a, mut b, mut c]: [Vec3; 3]) -> [Vec3; 3] {
    if vertex_less(b, a) {
        (a, b) = (b, a);
    }
    if vertex_less(c, b) {
        (b, c) = (c, b);
    }
    if vertex_less(b, a) {
        (a, b) = (b, a);
    }
    [a, b, c]
}

/// Spelled out, so that no library or compiler chooses another order.
#[inline(always)]
pub(super) fn cross(x: Vec3, y: Vec3) -> Vec3 {
    Vec3::new(
        x.y * y.z - x.z * y.y,
        x.z * y.x - x.x * y.z,
        x.x * y.y - x.y * y.x,
    )
}
