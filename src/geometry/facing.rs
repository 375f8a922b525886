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
//! that keeps denormal numbers as on one that flushes them to zero. Therefore every intermediate
//! result below 2⁻¹²⁰ is taken as zero: then each operand is zero or at least 2⁻¹²⁰, and a result
//! that could be denormal (below 2⁻¹²⁶) is zero on both. That needs inputs without denormals
//! ([`crate::scene::mesh::canonical`]), and no contraction of a product and a sum into one
//! rounding: `precise` in GLSL, the rule of the language in Rust.

use glam::{Vec3, Vec4};

/// Results of smaller magnitude count as zero: 2⁻¹²⁰.
const FLUSH_BELOW: f32 = f32::from_bits((127 - 120) << 23);

/// The facing of the triangle `a`, `b`, `c`: +1 if the light lies on the side from which the
/// triangle looks counter-clockwise, -1 on the other side, 0 if it lies in the plane of the
/// triangle as far as the arithmetic can tell, and for a triangle with two equal vertices.
///
/// `light` is homogeneous: `w` = 1 for a position, 0 for the direction towards the light.
/// Cyclic rotation of the vertices keeps the answer and a swap negates it, without exception.
pub fn facing(a: Vec3, b: Vec3, c: Vec3, light: Vec4) -> i32 {
    let (mut a, mut b, mut c) = (a, b, c);
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

    // (x × y) · e = ((b - a) × (c - a)) · (light - a): positive where a, b, c look
    // counter-clockwise.
    let x = difference3(c, a);
    let y = difference3(light.truncate(), scaled3(a, light.w));
    let e = difference3(b, a);
    let n = Vec3::new(
        difference(product(x.y, y.z), product(x.z, y.y)),
        difference(product(x.z, y.x), product(x.x, y.z)),
        difference(product(x.x, y.y), product(x.y, y.x)),
    );
    let d = sum(sum(product(n.x, e.x), product(n.y, e.y)), product(n.z, e.z));

    // Two comparisons: a d that overflowed to NaN has no side.
    let sorted = i32::from(d > 0.0) - i32::from(d < 0.0);
    if swapped { -sorted } else { sorted }
}

/// The vertex order: by x, then y, then z. Numbers, not bits: -0 equals +0.
fn vertex_less(a: Vec3, b: Vec3) -> bool {
    a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)))
}

fn flush(r: f32) -> f32 {
    if r.abs() < FLUSH_BELOW { 0.0 } else { r }
}

fn product(a: f32, b: f32) -> f32 {
    flush(a * b)
}

fn sum(a: f32, b: f32) -> f32 {
    flush(a + b)
}

fn difference(a: f32, b: f32) -> f32 {
    flush(a - b)
}

fn difference3(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(
        difference(a.x, b.x),
        difference(a.y, b.y),
        difference(a.z, b.z),
    )
}

fn scaled3(a: Vec3, scale: f32) -> Vec3 {
    Vec3::new(
        product(a.x, scale),
        product(a.y, scale),
        product(a.z, scale),
    )
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

    /// Any number that a GPU without denormals can hold, the smallest ones often.
    fn canonical_number() -> impl Strategy<Value = f32> {
        prop_oneof![
            Just(0.0),
            prop::num::f32::NORMAL,
            (1u32..0x0800_0000, prop::bool::ANY).prop_map(|(bits, negative)| {
                let r = flush_denormal(f32::from_bits(bits));
                if negative { -r } else { r }
            }),
        ]
    }

    fn flush_denormal(r: f32) -> f32 {
        if r.is_subnormal() { 0.0 } else { r }
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

    #[test]
    fn the_shader_flushes_below_the_same_number() {
        let shader = include_str!("../../shaders/shared/facing.glsl");
        let (_, rest) = shader.split_once("FACING_FLUSH_BELOW = ").unwrap();
        let literal: f32 = rest.split_once(';').unwrap().0.parse().unwrap();
        assert_eq!(literal.to_bits(), FLUSH_BELOW.to_bits());
        assert_eq!(FLUSH_BELOW, 2f32.powi(-120));
    }

    proptest! {
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

        /// The induction step of the claim above: with canonical operands, an operation has one
        /// result, canonical again, whether or not the device keeps denormals.
        #[test]
        fn denormals_make_no_difference(a in canonical_number(), b in canonical_number()) {
            for r in [a * b, a + b, a - b] {
                prop_assert_eq!(flush(r).to_bits(), flush(flush_denormal(r)).to_bits());
                prop_assert!(!flush(r).is_subnormal());
            }
        }
    }
}
