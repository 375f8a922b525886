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
        Vec3::new(-1.3, 0.4, -0.7) + Vec3::new(2.1, 0.13, 0.9) * s + Vec3::new(0.17, 1.9, 0.31) * t
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
