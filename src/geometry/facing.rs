//! Which side of a triangle the light is on: the one decision that every shadow volume rests on.
//!
//! Milet, Kobrtek, Zemčík and Pečiva (*Fast and Robust Tessellation-Based Silhouette Shadows*,
//! 2014, algorithms 3 and 4) found that a silhouette has holes as soon as two edges of a triangle
//! get different answers to this question. Here a triangle has one answer, whatever order its
//! vertices come in: they are sorted, the light plane is always the one through the *reference
//! edge* (from the smallest to the largest vertex), and the parity of the sort says whether the
//! given winding is that of the sorted triangle or the other one.
//!
//! `shaders/shared/facing.glsl` is the twin of this file and has to agree bit for bit, on a GPU
//! that keeps denormal numbers as on one that flushes them to zero. So vertices and light lie on a
//! grid of 2⁻⁴⁰ ([`crate::scene::mesh::canonical`]): then every difference is a multiple of 2⁻⁴⁰
//! too, every product of two of 2⁻⁸⁰ and of three of 2⁻¹²⁰ (rounding keeps them so), and nothing
//! ever comes near the denormals below 2⁻¹²⁶. Nor may a product and a sum be contracted into one
//! rounding: `precise` sees to it in GLSL, the rule of the language in Rust.

use glam::{Vec3, Vec4};
use serde::{Deserialize, Serialize};

/// How the edges of a triangle come to agree on its facing. The numbers are those of `DETERMINISM`
/// in `shaders/shared/facing.glsl`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Determinism {
    /// All use the light plane through the triangle's reference edge (Milet et al. 2014).
    #[default]
    ReferenceEdge = 0,
    /// All ask all three light planes, and where these disagree the triangle has no facing (Pečiva
    /// et al. 2013).
    ConsistentTriangle = 1,
    /// They do not: each asks the light plane through itself (Kim et al. 2008). Fails on triangles
    /// that are nearly edge-on to the light.
    None = 2,
}

impl Determinism {
    /// The facing of a triangle, see [`facing`]; with [`Self::None`], as its edge from `a` to `b` takes
    /// it.
    pub fn facing(self, a: Vec3, b: Vec3, c: Vec3, light: Vec4) -> i32 {
        match self {
            Self::ReferenceEdge => facing(a, b, c, light),
            Self::ConsistentTriangle => by_sorting([a, b, c], light, consistent_facing),
            Self::None => -light_plane_side(a, b, c, light),
        }
    }
}

/// The facing of the triangle `a`, `b`, `c`: +1 if the light lies on the side from which the
/// triangle looks counter-clockwise, -1 on the other side, 0 if it lies in the plane of the
/// triangle as far as the arithmetic can tell, and for a triangle with two equal vertices.
///
/// `light` is homogeneous: `w` = 1 for a position, 0 for the direction towards the light.
/// Cyclic rotation of the vertices keeps the answer and a swap negates it, without exception.
pub fn facing(a: Vec3, b: Vec3, c: Vec3, light: Vec4) -> i32 {
    by_sorting([a, b, c], light, reference_facing)
}

/// What `of_sorted` says of the vertices in the vertex order, with the sign of the given order.
fn by_sorting(
    [mut a, mut b, mut c]: [Vec3; 3],
    light: Vec4,
    of_sorted: fn(Vec3, Vec3, Vec3, Vec4) -> i32,
) -> i32 {
    let mut swapped = false;
    if vertex_less(b, a) {
        (a, b, swapped) = (b, a, !swapped);
    }
    if vertex_less(c, b) {
        (b, c, swapped) = (c, b, !swapped);
    }
    if vertex_less(b, a) {
        (a, b, swapped) = (b, a, !swapped);
    }
    // Rounding could give such a triangle a side, and the sort has no parity to go with it.
    if a == b || b == c {
        return 0;
    }
    let sorted = of_sorted(a, b, c, light);
    if swapped { -sorted } else { sorted }
}

/// The facing of a triangle whose vertices are in the vertex order.
fn reference_facing(a: Vec3, b: Vec3, c: Vec3, light: Vec4) -> i32 {
    light_plane_side(a, c, b, light)
}

/// The facing of a triangle whose vertices are in the vertex order, if the light planes through all
/// three edges agree on it, else 0.
fn consistent_facing(a: Vec3, b: Vec3, c: Vec3, light: Vec4) -> i32 {
    let facings = [
        light_plane_side(a, c, b, light),
        -light_plane_side(a, b, c, light),
        -light_plane_side(b, c, a, light),
    ];
    if facings == [facings[0]; 3] {
        facings[0]
    } else {
        0
    }
}

/// On which side of the light plane through `a` and `c` the point `b` lies: the facing of a, b, c.
fn light_plane_side(a: Vec3, c: Vec3, b: Vec3, light: Vec4) -> i32 {
    // (x × y) · e = ((b - a) × (c - a)) · (light - a): positive where a, b, c look
    // counter-clockwise.
    let x = c - a;
    let y = light.truncate() - a * light.w;
    let e = b - a;
    let n = Vec3::new(
        x.y * y.z - x.z * y.y,
        x.z * y.x - x.x * y.z,
        x.x * y.y - x.y * y.x,
    );
    let d = n.x * e.x + n.y * e.y + n.z * e.z;
    // Two comparisons: a d that overflowed to NaN has no side.
    i32::from(d > 0.0) - i32::from(d < 0.0)
}

/// The vertex order: by x, then y, then z. Numbers, not bits: -0 equals +0.
pub fn vertex_less(a: Vec3, b: Vec3) -> bool {
    a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)))
}

#[cfg(test)]
#[path = "facing_tests.rs"]
mod tests;
