//! The reference against analytic shadows, against brute force, and against what must never leak.

use glam::{DVec2, DVec3, Mat4, Vec3, Vec4};
use proptest::prelude::*;

use super::fixtures::{Random, Scene, sphere, square, view};
use super::segment::{ExactLight, Segment};
use super::view::Projection;
use super::{BoundaryProbe, Reference, ReferenceError, ReferenceView, Verdict, Visibility};
use crate::scene::Light;

const LIGHT: Light = Light::at(Vec4::new(0.3, 6.0, 0.2, 1.0));
const ROOF: [Vec3; 3] = [
    Vec3::new(-1.0, 2.0, -1.0),
    Vec3::new(0.2, 2.0, 1.3),
    Vec3::new(1.1, 2.0, -0.4),
];

fn centres(view: &ReferenceView) -> impl Iterator<Item = (usize, DVec2)> {
    let width = view.width as usize;
    (0..view.pixel_count()).map(move |i| {
        (
            i,
            DVec2::new((i % width) as f64 + 0.5, (i / width) as f64 + 0.5),
        )
    })
}

/// Whether the light sees a point of the ground through the roof.
fn under_roof(point: DVec3, light: Light) -> bool {
    let light = light.place.as_dvec4();
    let to_light = light.truncate() - light.w * point;
    let crossing = point + (2.0 - point.y) / to_light.y * to_light;
    let [a, b, c] = ROOF.map(Vec3::as_dvec3);
    let turns = [[a, b], [b, c], [c, a]].map(|[p, q]| (q - p).cross(crossing - p).y > 0.0);
    turns == [true; 3] || turns == [false; 3]
}

#[test]
fn a_roof_casts_its_projection() {
    let scene = Scene::default().cast(&[ROOF]).receive(&square(6.0, 0.0));
    let view = view(Vec3::new(4.0, 5.0, 6.0), Vec3::ZERO, 160, 120);
    for light in [LIGHT, Light::at(Vec4::new(0.2, 1.0, -0.3, 0.0))] {
        let (ids, mask) = scene.trace(light, &view);
        assert!(mask.count(Verdict::Ambiguous) < 3);
        let projection = Projection::new(&view).unwrap();
        let mut shadowed = 0;
        for (pixel, centre_px) in centres(&view) {
            let expected = match ids[pixel] {
                0 => Verdict::Background,
                1 => Verdict::Lit,
                _ => {
                    let ray = projection.ray(centre_px);
                    let point = ray.eye - ray.eye.y / ray.direction.y * ray.direction;
                    if under_roof(point, light) {
                        Verdict::Shadowed
                    } else {
                        Verdict::Lit
                    }
                }
            };
            shadowed += u32::from(expected == Verdict::Shadowed);
            let found = mask.verdict(pixel);
            assert!(
                found == expected || found == Verdict::Ambiguous,
                "{found:?} at {centre_px}"
            );
        }
        assert!(shadowed > 150, "{shadowed} pixels in shadow");
    }
}

#[test]
fn the_side_away_from_the_light_is_shadowed() {
    let scene = Scene::default().cast(&[ROOF]);
    let above = view(Vec3::new(0.1, 5.0, 0.0), Vec3::new(0.1, 2.0, 0.0), 16, 16);
    let below = view(Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.1, 2.0, 0.0), 16, 16);
    let lit = scene.trace(LIGHT, &above).1;
    let shadowed = scene.trace(LIGHT, &below).1;
    assert!(lit.count(Verdict::Lit) > 10 && lit.count(Verdict::Shadowed) == 0);
    assert!(shadowed.count(Verdict::Shadowed) > 10 && shadowed.count(Verdict::Lit) == 0);
}

#[test]
fn a_receiver_never_blocks() {
    let scene = Scene::default().receive(&[ROOF]).receive(&square(6.0, 0.0));
    let (_, mask) = scene.trace(LIGHT, &view(Vec3::new(4.0, 5.0, 6.0), Vec3::ZERO, 64, 48));
    assert_eq!(mask.count(Verdict::Shadowed), 0);
}

#[test]
fn a_light_in_the_own_plane_is_ambiguous() {
    let scene = Scene::default().cast(&square(1.0, 0.0));
    let view = view(Vec3::new(0.0, 3.0, 1.0), Vec3::ZERO, 16, 16);
    for light in [Vec4::new(5.0, 0.0, 0.0, 1.0), Vec4::X] {
        let (_, mask) = scene.trace(Light::at(light), &view);
        assert!(mask.count(Verdict::Ambiguous) > 10);
        assert_eq!(mask.count(Verdict::Lit) + mask.count(Verdict::Shadowed), 0);
    }
}

#[test]
fn triangles_in_the_own_plane_do_not_block() {
    let [one, other] = square(2.0, 0.0);
    let turned = |[a, b, c]: [Vec3; 3]| [c, b, a];
    let covering = square(3.0, 0.0);
    let scene = Scene::default()
        .cast(&[one, other, one, turned(one), turned(other)])
        .cast(&covering)
        .cast(&[[Vec3::ZERO, Vec3::X, Vec3::X * 0.5]]);
    let view = view(Vec3::new(1.0, 4.0, 2.0), Vec3::ZERO, 64, 48);
    let (_, lit) = scene.trace(LIGHT, &view);
    assert_eq!(
        lit.count(Verdict::Shadowed) + lit.count(Verdict::Ambiguous),
        0
    );
    let (_, shadowed) = scene.trace(
        Light::at(LIGHT.place * Vec4::new(1.0, -1.0, 1.0, 1.0)),
        &view,
    );
    assert_eq!(
        shadowed.count(Verdict::Lit) + shadowed.count(Verdict::Ambiguous),
        0
    );
}

#[test]
fn a_pixel_of_a_degenerate_triangle_is_ambiguous() {
    let line = [
        Vec3::new(-3.0, 0.0, 0.0),
        Vec3::ZERO,
        Vec3::new(3.0, 0.0, 0.0),
    ];
    let reference = Scene::default().cast(&[line]).reference();
    let view = view(Vec3::new(0.0, 4.0, 0.0), Vec3::ZERO, 1, 1);
    let mask = reference.trace(LIGHT, &view, &[1]).unwrap();
    assert_eq!(mask.visibility, [Some(Visibility::UNKNOWN)]);
}

#[test]
fn random_soups_agree_with_brute_force() {
    let mut random = Random(1);
    let mut ambiguous = 0;
    for soup in 0..50 {
        let scene = Scene::default()
            .cast(&random.soup(30))
            .receive(&random.soup(10));
        let light = (3.0 * random.point()).extend((soup % 2) as f64).as_vec4();
        let light = Light::at(light);
        let view = view((2.5 * random.point()).as_vec3(), Vec3::ZERO, 48, 36);
        let projection = Projection::new(&view).unwrap();
        let (ids, mask) = scene.trace(light, &view);
        ambiguous += mask.count(Verdict::Ambiguous);
        for (pixel, centre_px) in centres(&view) {
            let ray = projection.ray(centre_px);
            assert_eq!(ids[pixel], scene.brute_force_id(&ray, &projection));
            let expected = match ids[pixel] {
                0 => Verdict::Background,
                id => scene.brute_force(light, &ray, id as usize - 1),
            };
            let found = mask.verdict(pixel);
            assert!(
                found == expected || found == Verdict::Ambiguous,
                "soup {soup}, {centre_px}"
            );
        }
    }
    // One in a thousand: outlines within the rasteriser's grid of a centre.
    assert!(ambiguous < 100, "{ambiguous} ambiguous pixels");
}

#[test]
fn a_closed_sphere_never_leaks() {
    let triangles = sphere(Vec3::new(0.1, -0.2, 0.3), 1.0, 24);
    let scene = Scene::default().cast(&triangles).receive(&square(0.1, 0.0));
    let reference = scene.reference();
    // The start is free to choose: only which triangle it belongs to must be known.
    let own = *reference.tree.primitive(scene.casters);
    let mut random = Random(2);
    let mut undecided = 0;
    for i in 0..100_000 {
        let [a, b, _] = triangles[random.below(triangles.len())].map(Vec3::as_dvec3);
        let share = if i % 4 == 0 { 0.0 } else { random.unit() };
        let start = 0.3 * random.point();
        let light =
            ExactLight::Point(start + (2.0 + random.unit()) * (a + share * (b - a) - start));
        let segment = Segment::new(start, light, 1.3);
        match reference.occlusion(&own, &segment, &mut None) {
            Visibility::NONE => {}
            Visibility::UNKNOWN if !(1e-6..1.0 - 1e-6).contains(&share) => undecided += 1,
            other => panic!("{other:?} through {share} of an edge"),
        }
    }
    assert!(
        undecided <= 25_001,
        "only segments through vertices may stay undecided"
    );
}

/// Ids from a view shifted by a part of a pixel: as when a rasteriser snaps vertices, some centres
/// lie outside the triangle named.
#[test]
fn snapped_ids_are_judged_too() {
    let scene = Scene::default()
        .cast(&sphere(Vec3::Y, 0.8, 40))
        .cast(&sphere(Vec3::new(1.4, 0.5, 0.3), 0.4, 30))
        .receive(&square(6.0, 0.0));
    let view = view(Vec3::new(2.0, 2.0, 3.0), Vec3::Y * 0.5, 320, 240);
    let reference = scene.reference();
    let shift = Mat4::from_translation(Vec3::new(0.02 / 320.0, 0.01 / 240.0, 0.0));
    let shifted = ReferenceView {
        view_projection: shift * view.view_projection,
        ..view
    };
    let ids = reference.visible_ids(&view).unwrap();
    let shifted_ids = reference.visible_ids(&shifted).unwrap();
    let moved = ids
        .iter()
        .zip(&shifted_ids)
        .filter(|(id, shifted)| id != shifted)
        .count();
    let mask = reference.trace(LIGHT, &view, &shifted_ids).unwrap();
    assert!(moved > 30, "{moved} ids moved");
    // Where the outline of a sphere passes a centre by less than the rasteriser's grid.
    let ambiguous = mask.count(Verdict::Ambiguous);
    assert!(ambiguous < 20, "{ambiguous}");
}

#[test]
fn a_shadow_thinner_than_a_pixel_is_found_between_centres() {
    // Seen from straight above, a pixel of the ground is one unit wide; the light stands at 45°,
    // so that the strip's shadow falls ten units to the left of it.
    let eye = Vec3::new(0.0, 32.0 / 30f32.to_radians().tan(), 0.0);
    let view = view(eye, Vec3::ZERO, 64, 64);
    let at = |x: f32, z: f32| Vec3::new(x, 10.0, z);
    let strip = [at(9.7, -60.0), at(10.3, -60.0), at(10.0, 60.0)];
    let scene = Scene::default().cast(&[strip]).receive(&square(99.0, 0.0));
    let light = Light::at(Vec4::new(1.0, 1.0, 0.0, 0.0));
    let reference = scene.reference();
    let (_, mask) = scene.trace(light, &view);
    let probe = BoundaryProbe::new(&reference, light, &view, &mask, 0).unwrap();
    let near: Vec<u32> = (0..64).filter(|&x| probe.near_boundary(x, 20)).collect();
    assert!(
        (0..64).all(|x| !mask.boundary_among_neighbours(x, 20)),
        "no centre is in shadow"
    );
    assert_eq!(near, [31, 32]);
}

#[test]
fn what_cannot_be_traced_is_an_error() {
    let bad = Reference::new(&[Vec3::ZERO, Vec3::NAN], &[[0, 0, 1]], |_| true).err();
    assert_eq!(bad, Some(ReferenceError::BadTriangle { triangle: 0 }));
    let missing = Reference::new(&[Vec3::ZERO], &[[0, 0, 0], [0, 0, 1]], |_| true).err();
    assert_eq!(missing, Some(ReferenceError::BadTriangle { triangle: 1 }));

    let reference = Scene::default().cast(&[ROOF]).reference();
    let view = view(Vec3::Y * 5.0, Vec3::ZERO, 2, 1);
    let trace = |light, ids: &[u32]| reference.trace(light, &view, ids).err();
    assert_eq!(
        trace(LIGHT, &[0]),
        Some(ReferenceError::WrongSize {
            expected: 2,
            found: 1
        })
    );
    let unknown = ReferenceError::UnknownTriangle {
        pixel: 1,
        id: 2,
        triangles: 1,
    };
    assert_eq!(trace(LIGHT, &[0, 2]), Some(unknown));
    for light in [Vec4::ZERO, Vec4::new(f32::NAN, 0.0, 0.0, 1.0)] {
        let error = trace(Light::at(light), &[0, 0]);
        assert_eq!(error, Some(ReferenceError::BadLight));
    }
    let ball = Light {
        radius: 0.1,
        ..LIGHT
    };
    assert_eq!(trace(ball, &[0, 0]), Some(ReferenceError::LightHasSize));
}

#[test]
fn an_empty_scene_is_background() {
    let view = view(Vec3::Y, Vec3::ZERO, 4, 4);
    let (ids, mask) = Scene::default().trace(LIGHT, &view);
    assert_eq!(ids, [0; 16]);
    assert_eq!(mask.count(Verdict::Background), 16);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Margins are relative, and a power of two scales exactly: not one verdict may change.
    #[test]
    fn scale_does_not_matter(seed in any::<u64>(), exponent in -12i32..12) {
        let mut random = Random(seed);
        let soup = random.soup(20);
        let light = (3.0 * random.point()).as_vec3();
        let view = view((2.5 * random.point()).as_vec3(), Vec3::ZERO, 24, 18);
        let (ids, mask) = Scene::default().cast(&soup).trace(Light::at(light.extend(1.0)), &view);

        let factor = 2f32.powi(exponent);
        let soup: Vec<_> = soup.iter().map(|corners| corners.map(|p| p * factor)).collect();
        let unscale = Mat4::from_scale(Vec3::splat(1.0 / factor));
        let view = ReferenceView { view_projection: view.view_projection * unscale, ..view };
        let scaled = Scene::default().cast(&soup).trace(Light::at((light * factor).extend(1.0)), &view);
        prop_assert_eq!(scaled, (ids, mask));
    }

    /// With one more caster, what was in shadow stays so.
    #[test]
    fn a_caster_never_takes_shadow_away(seed in any::<u64>()) {
        let mut random = Random(seed);
        let scene = Scene::default().cast(&random.soup(20));
        let light = Light::at((3.0 * random.point()).as_vec3().extend(0.0));
        let view = view((2.5 * random.point()).as_vec3(), Vec3::ZERO, 24, 18);
        let (ids, before) = scene.trace(light, &view);
        let more = scene.cast(&random.soup(10));
        let after = more.reference().trace(light, &view, &ids).unwrap();
        for (before, after) in before.verdicts().zip(after.verdicts()) {
            prop_assert!(before != Verdict::Shadowed || after == Verdict::Shadowed);
        }
    }
}
