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
mod tests {
    use super::*;
    use glam::DVec3;
    use proptest::prelude::*;

    fn vertex() -> impl Strategy<Value = Vec3> {
        // Small whole numbers make equal coordinates and exact degeneracy common.
        let whole = (-3i8..4).prop_map(f32::from).boxed();
        let any = (-1e3f32..1e3).boxed();
        let coordinate = prop_oneof![whole, any];
        [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from_array)
    }

    fn triangle() -> impl Strategy<Value = [Vec3; 3]> {
        [vertex(), vertex(), vertex()]
    }

    fn light() -> impl Strategy<Value = Vec4> {
        (vertex(), prop::bool::ANY).prop_map(|(p, point)| p.extend(f32::from(u8::from(point))))
    }

    #[test]
    fn light_on_the_counter_clockwise_side_is_positive() {
        // Seen from +z, x to the right and y up, this triangle runs counter-clockwise.
        let [a, b, c] = [Vec3::ZERO, Vec3::X, Vec3::Y];
        assert_eq!(facing(a, b, c, Vec4::new(0.2, 0.2, 5.0, 1.0)), 1);
        assert_eq!(facing(a, b, c, Vec4::new(9.0, 9.0, -0.1, 1.0)), -1);
        assert_eq!(facing(a, b, c, Vec4::new(9.0, 9.0, 0.0, 1.0)), 0);
        assert_eq!(facing(a, b, c, Vec4::new(1.0, 1.0, 1.0, 0.0)), 1);
        assert_eq!(facing(a, b, c, Vec4::new(1.0, 1.0, -1.0, 0.0)), -1);
    }

    #[test]
    fn what_overflows_or_is_not_a_number_has_no_side() {
        let huge = Vec3::splat(f32::MAX);
        assert_eq!(
            facing(-huge, huge, Vec3::new(f32::MAX, -f32::MAX, 0.0), Vec4::ONE),
            0
        );
        assert_eq!(facing(Vec3::NAN, Vec3::X, Vec3::Y, Vec4::ONE), 0);
    }

    /// Rounding decides which side of a light plane an edge-on triangle is on, and planes differ.
    #[test]
    fn edge_on_triangles_are_consistent_or_dropped() {
        let at = |i: usize| {
            let (s, t) = ((i % 7) as f32 / 7.0, (i / 7) as f32 / 9.0);
            Vec3::new(-1.3, 0.4, -0.7)
                + Vec3::new(2.1, 0.13, 0.9) * s
                + Vec3::new(0.17, 1.9, 0.31) * t
        };
        let light = (at(3) * 0.25 + at(40) * 0.75 + (at(60) - at(2)) * 3.0).extend(1.0);
        let (mut dropped, mut kept, mut disagreeing) = (0, 0, 0);
        for i in 0..40 {
            let [mut a, mut b, o] = [at(i), at(i + 9), at(i + 15)];
            if vertex_less(b, a) {
                std::mem::swap(&mut a, &mut b);
            }
            let reference = facing(a, b, o, light);
            let consistent = Determinism::ConsistentTriangle.facing(a, b, o, light);
            assert!(consistent == reference || consistent == 0);
            dropped += u32::from(consistent == 0 && reference != 0);
            kept += u32::from(consistent != 0);
            let by_edges = [(a, b, o), (b, o, a), (o, a, b)]
                .map(|(a, b, o)| Determinism::None.facing(a, b, o, light));
            disagreeing += u32::from(by_edges != [by_edges[0]; 3]);
        }
        assert!(
            dropped > 0 && kept > 0 && disagreeing > 0,
            "{dropped} dropped, {kept} kept, {disagreeing} disagreeing"
        );
    }

    proptest! {
        #[test]
        fn a_consistent_triangle_keeps_its_facing_however_it_is_asked(
            [a, b, c] in triangle(),
            l in light(),
        ) {
            let ask = |a, b, c| Determinism::ConsistentTriangle.facing(a, b, c, l);
            let f = ask(a, b, c);
            prop_assert_eq!(ask(b, c, a), f);
            prop_assert_eq!(ask(b, a, c), -f);
            prop_assert!(f == 0 || f == facing(a, b, c, l));
        }

        #[test]
        fn a_swap_negates_and_a_rotation_keeps([a, b, c] in triangle(), l in light()) {
            let f = facing(a, b, c, l);
            prop_assert_eq!(facing(b, c, a, l), f);
            prop_assert_eq!(facing(c, a, b, l), f);
            prop_assert_eq!(facing(b, a, c, l), -f);
            prop_assert_eq!(facing(a, c, b, l), -f);
            prop_assert_eq!(facing(c, b, a, l), -f);
        }

        #[test]
        fn two_equal_vertices_have_no_side(a in vertex(), b in vertex(), l in light()) {
            prop_assert_eq!(facing(a, a, b, l), 0);
            prop_assert_eq!(facing(a, b, a, l), 0);
            prop_assert_eq!(facing(b, a, a, l), 0);
        }

        #[test]
        fn a_power_of_two_keeps_the_answer(
            [a, b, c] in triangle(),
            l in light(),
            exponent in -10i32..10,
        ) {
            let s = 2f32.powi(exponent);
            let scaled_light = (l.truncate() * s).extend(l.w);
            prop_assert_eq!(facing(a * s, b * s, c * s, scaled_light), facing(a, b, c, l));
        }

        #[test]
        fn agrees_with_a_well_conditioned_determinant([a, b, c] in triangle(), l in light()) {
            let [p, q, r] = [a, b, c].map(Vec3::as_dvec3);
            let y = l.truncate().as_dvec3() - p * f64::from(l.w);
            let d = DVec3::dot((q - p).cross(r - p), y);
            // What the differences and products could be off by, generously.
            let size = [p, q, r, l.truncate().as_dvec3()].map(|v| v.abs().max_element());
            let error = size.into_iter().fold(0.0, f64::max).powi(3) * 2e-5;
            prop_assume!(d.abs() > error);
            prop_assert_eq!(f64::from(facing(a, b, c, l)), d.signum());
        }

        /// On the grid of canonical positions, no step of the decision comes near the denormals,
        /// however small its operands are.
        #[test]
        fn no_step_is_denormal(
            numbers in prop::array::uniform12(-300i32..300),
            exponents in prop::array::uniform12(-40i32..20),
        ) {
            let n: [f32; 12] = std::array::from_fn(|i| numbers[i] as f32 * 2f32.powi(exponents[i]));
            let v = |i: usize| Vec3::new(n[i], n[i + 1], n[i + 2]);
            let (x, y, e) = (v(6) - v(0), v(9) - v(0), v(3) - v(0));
            let n = [x.y * y.z, x.z * y.y, x.y * y.z - x.z * y.y];
            let all = [x.y, y.z, e.x, n[0], n[1], n[2], n[2] * e.x, n[2] * e.x + n[0] * e.y];
            for r in all {
                prop_assert!(r == 0.0 || r.abs() >= 2f32.powi(-120), "{}", r);
            }
        }
    }
}
