//! Whether a triangle blocks the light of a point: the one test of all shadow rays.
//!
//! The line from the light through the point passes between the three light planes of the triangle, and the triangle's
//! plane lies between light and point. On which side of a light plane a point lies is the same question as which way a
//! triangle faces (see [`facing`](crate::geometry::facing())): it is asked of the edge from its smaller to its larger
//! vertex, in the same arithmetic for both triangles of an edge, so that no light passes between two neighbours. Points
//! on a light plane are on both sides of it. (Only through a vertex, in the last bits: the edges there round each for itself.)
//!
//! A triangle that the light sees edge-on blocks nothing, as it has no shadow volume. And none blocks the light of what
//! it touches: a point is in contact with a triangle where rounding could have moved it from one side of its plane to the
//! other. A surface so never shadows itself, and needs neither a bias nor its own number for that; what is lost is the
//! shadow of what is so close.
//!
//! Rounding is kept small: a [`SurfacePoint`] is a corner of its own triangle and the way from there, so that what is near
//! is told apart to the last bits of distances between neighbours, not of coordinates. Where the light grazes a surface
//! that matters: there the light plane through an edge and the surface are nearly one.
//!
//! `shaders/shared/blocks.wgsl` is the twin of this file.

use super::triangle::{ROUNDING, RayTriangle, cross, normal};
use glam::{Vec3, Vec4};

/// What roundings move a point by, as a part of the longer side of its own triangle: those of both sides, their weights,
/// their sum, and of the vector from another triangle to the point's.
pub(super) const OF_POINT: f32 = 4.0 * ROUNDING;

/// A point of a triangle that is seen.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// A corner of the triangle.
    pub corner: Vec3,
    /// From there to the point.
    pub way: Vec3,
    /// What rounding may have moved it by.
    pub uncertainty: f32,
}

impl SurfacePoint {
    /// With weights of the second and the third corner.
    pub fn new([a, b, c]: [Vec3; 3], [of_b, of_c]: [f32; 2]) -> Self {
        let (e, x) = (b - a, c - a);
        Self {
            corner: a,
            way: of_b * e + of_c * x,
            uncertainty: OF_POINT * e.length().max(x.length()),
        }
    }

    /// The vector to it from a point that has no rounding.
    fn from(&self, point: Vec3) -> Vec3 {
        (self.corner - point) + self.way
    }
}

/// A triangle before a light, and its shadow volume: four planes with the shadow on their negative sides.
#[derive(Clone, Copy, Debug)]
pub struct Blocker {
    /// The smallest corner, a point of the planes of `ab`, `ac` and [`own`](Self::own).
    pub a: Vec3,
    /// The middle corner, a point of the plane of [`bc`](Self::bc).
    pub b: Vec3,
    c: Vec3,
    light: Vec4,
    /// +1 or -1: the triangle's facing, with its corners in this order.
    side: f32,
    /// Normal of a light plane.
    pub ab: Vec3,
    /// As `ab`.
    pub ac: Vec3,
}

impl Blocker {
    /// `None` if the light sees it edge-on.
    #[inline(always)]
    pub fn new(triangle: &RayTriangle, light: Vec4) -> Option<Self> {
        let [a, b, c] = triangle.corners();
        let (e, x) = (b - a, c - a);
        let y = light.truncate() - a * light.w;
        // As `facing` has it.
        let n = cross(x, y);
        let d = n.x * e.x + n.y * e.y + n.z * e.z;
        if d == 0.0 || d.is_nan() || a == b || b == c {
            return None;
        }
        let side = 1f32.copysign(d);
        Some(Self {
            a,
            b,
            c,
            light,
            side,
            ab: side * cross(e, y),
            ac: -side * n,
        })
    }

    /// As `ab`.
    #[inline(always)]
    pub fn bc(&self) -> Vec3 {
        let y = self.light.truncate() - self.b * self.light.w;
        self.side * cross(self.c - self.b, y)
    }

    /// Normal of the triangle, towards the light.
    #[inline(always)]
    pub fn own(&self) -> Vec3 {
        self.side * normal([self.a, self.b, self.c])
    }

    /// Whether it blocks the light of a point.
    pub fn blocks(&self, triangle: &RayTriangle, point: &SurfacePoint) -> bool {
        let (from_a, from_b) = (point.from(self.a), point.from(self.b));
        let within = |normal: Vec3, from: Vec3| dot(normal, from) <= 0.0;
        let contact = triangle.contact + triangle.double_area * point.uncertainty;
        within(self.ab, from_a)
            && within(self.ac, from_a)
            && within(self.bc(), from_b)
            && dot(self.own(), from_a) < -contact
    }
}

#[inline(always)]
fn dot(x: Vec3, y: Vec3) -> f32 {
    x.x * y.x + x.y * y.y + x.z * y.z
}
