use super::*;
use crate::scene::{Part, SphereGrid};
use glam::Vec3;
use proptest::prelude::*;

const LAMP: Vec4 = Vec4::new(0.0, 10.0, 0.0, 1.0);

/// A level square around a point, of two triangles that face up.
fn square(centre: Vec3, half: f32) -> Vec<[Vec3; 3]> {
    let at = |x: f32, z: f32| centre + half * Vec3::new(x, 0.0, z);
    let [a, b, c, d] = [at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)];
    vec![[a, b, c], [a, c, d]]
}

fn proven(light: Vec4, mesh: &Mesh) -> Vec<bool> {
    let topology = Topology::build(mesh);
    let triangles = EdgeTriangles::build(mesh, &topology);
    let all = mesh.casters().flat_map(|object| object.triangles.clone());
    occluded(light, (mesh, &topology, &triangles), all.collect())
}

/// Which of the two triangles of a square at the origin are proven to be behind these others.
fn square_behind(light: Vec4, others: &[Vec<[Vec3; 3]>]) -> [bool; 2] {
    let mut parts = vec![Part::of_triangles("below", &square(Vec3::ZERO, 1.0))];
    parts.extend(
        others
            .iter()
            .map(|other| Part::of_triangles("above", other)),
    );
    let found = proven(light, &parts.into_iter().collect());
    [found[0], found[1]]
}

#[test]
fn what_is_wholly_behind_a_surface_is_occluded_and_what_is_partly_so_is_not() {
    let above = |x, half| square(Vec3::new(x, 5.0, 0.0), half);
    assert_eq!(square_behind(LAMP, &[above(0.0, 0.6)]), [true; 2]);
    // At half the way to the lamp half the size would do, but for doubt.
    assert_eq!(square_behind(LAMP, &[above(0.0, 0.499)]), [false; 2]);
    assert_eq!(square_behind(LAMP, &[above(0.3, 0.6)]), [false; 2]);
    let sun = Vec4::new(0.0, 1.0, 0.0, 0.0);
    assert_eq!(square_behind(sun, &[above(0.0, 1.1)]), [true; 2]);
    assert_eq!(square_behind(sun, &[above(0.0, 0.9)]), [false; 2]);
    let below = square(Vec3::new(0.0, -1.0, 0.0), 9.0);
    let beyond = square(Vec3::new(0.0, 11.0, 0.0), 9.0);
    assert_eq!(square_behind(LAMP, &[below, beyond]), [false; 2]);
}

#[test]
fn copies_do_not_occlude_each_other() {
    assert_eq!(square_behind(LAMP, &[square(Vec3::ZERO, 1.0)]), [false; 2]);
    let lifted = square(Vec3::Y * 1e-6, 1.0);
    assert_eq!(square_behind(LAMP, &[lifted]), [false; 2]);
}

#[test]
fn a_surface_may_have_folds_but_no_holes() {
    let flat = square(Vec3::new(0.0, 5.0, 0.0), 2.0);
    let [a, b, c] = flat[0];
    let middle = Vec3::new(-0.1, 5.0, 0.3);
    let around = |middle: Vec3| vec![[a, b, middle], [b, c, middle], [c, a, middle], flat[1]];
    assert_eq!(square_behind(LAMP, &[around(middle)]), [true; 2]);
    // A fold that hangs over.
    let aside = around(b + (b - middle) * 0.2);
    assert_eq!(square_behind(LAMP, &[aside]), [true; 2]);
    let mut hole = around(middle);
    hole.remove(0);
    // It is all on one side of the diagonal.
    assert_eq!(square_behind(LAMP, &[hole]), [false, true]);
}

#[test]
fn what_makes_no_side_smaller_is_not_left_out() {
    let left_out_of = |parts: &[Vec<[Vec3; 3]>]| {
        let floor = square(Vec3::new(0.0, -5.0, 0.0), 9.0);
        let parts = parts.iter().chain([&floor]);
        let mesh: Mesh = parts.map(|part| Part::of_triangles("part", part)).collect();
        let topology = Topology::build(&mesh);
        let triangles = EdgeTriangles::build(&mesh, &topology);
        let are_closed = triangles.closed_casters(&mesh, &topology);
        left_out(LAMP, (&mesh, &topology, &triangles), &are_closed)
    };
    let above = square(Vec3::new(0.0, 5.0, 0.0), 0.6);
    let whole = left_out_of(&[square(Vec3::ZERO, 1.0), above.clone()]);
    assert_eq!(whole, [true, true, false, false, false, false]);
    // Its shadow falls on nothing.
    let floor_itself = left_out_of(&[square(Vec3::new(0.0, -5.0, 0.0), 1.0)]);
    assert!(!floor_itself.contains(&true), "{floor_itself:?}");
    // All but one of a strip's triangles are in shadow, but then a side across it comes in place of two short ones.
    let strip = [[-1.0, 0.0], [0.0, 0.9], [9.0, 0.0], [10.0, 0.9]];
    let at = |i: usize, z: f32| Vec3::new(strip[i][0], 0.0, z * (0.5 + strip[i][1]));
    let strip = vec![
        [at(0, -1.0), at(0, 1.0), at(1, -1.0)],
        [at(1, -1.0), at(0, 1.0), at(1, 1.0)],
        [at(1, -9.0), at(1, -1.0), at(1, 1.0)],
    ];
    let kept = left_out_of(&[strip, above]);
    assert!(!kept[2], "{kept:?}");
}

/// Whether a triangle has a point between another one and the light, by a ray in double precision.
fn is_between(mesh: &Mesh, triangle: usize, from: DVec3, light: Vec4) -> bool {
    let [a, b, c] = mesh.corners(triangle).map(|corner| corner.as_dvec3());
    let towards = light.truncate().as_dvec3() - from * f64::from(light.w);
    let (u, v) = (b - a, c - a);
    let across = towards.cross(v);
    let determinant = u.dot(across);
    let at = from - a;
    let s = at.dot(across) / determinant;
    let t = towards.dot(at.cross(u)) / determinant;
    let along = v.dot(at.cross(u)) / determinant;
    s >= -1e-9
        && t >= -1e-9
        && s + t <= 1.0 + 1e-9
        && along > 1e-9
        && (light.w == 0.0 || along < 1.0)
}

fn spheres() -> Mesh {
    let grid = SphereGrid {
        rows: 2,
        columns: 2,
        slices: 8,
        shells: 1,
    };
    grid.mesh().unwrap()
}

#[test]
fn most_of_the_dark_half_of_a_sphere_is_behind_its_lit_half() {
    let mesh = spheres();
    let found = proven(LAMP, &mesh);
    let casters = mesh.caster_triangle_count();
    let share = found.iter().filter(|found| **found).count() as f64 / casters as f64;
    assert!((0.25..0.5).contains(&share), "{share}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// No point of what is proven to be occluded sees the light.
    #[test]
    fn nothing_lit_is_occluded(
        light in [-9.0f32..9.0, 0.5f32..12.0, -9.0f32..9.0].prop_map(Vec3::from_array),
        is_point in prop::bool::ANY,
        removed in 2usize..40,
        at in prop::collection::vec((0.001f64..0.999, 0.001f64..0.999), 12),
    ) {
        let light = light.extend(f32::from(u8::from(is_point)));
        let mesh = spheres().filtered(|triangle| triangle % removed != 0);
        let found = proven(light, &mesh);
        let casters: Vec<usize> = mesh.casters().flat_map(|object| object.triangle_range()).collect();
        for triangle in (0..found.len()).filter(|triangle| found[*triangle]) {
            let [a, b, c] = mesh.corners(triangle).map(|corner| corner.as_dvec3());
            for (s, t) in &at {
                let (s, t) = if s + t > 1.0 { (1.0 - s, 1.0 - t) } else { (*s, *t) };
                let point = a + (b - a) * s + (c - a) * t;
                let mut others = casters.iter().filter(|other| **other != triangle);
                prop_assert!(others.any(|other| is_between(&mesh, *other, point, light)), "{triangle}");
            }
        }
    }
}
