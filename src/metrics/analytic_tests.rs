//! The reference, and errors counted by it, against shadows that a formula gives.

use glam::{DVec3, Vec3};

use std::path::Path;

use super::shot::{CENTRE, HEIGHT, LIGHT, RADIUS, Shot, WIDTH};
use crate::reference::fixtures::{Scene, square};
use crate::reference::{Reference, ReferenceView, Verdict};
use crate::scene::{ModelSearch, SceneFile};

const BOX_LOW: DVec3 = DVec3::new(-0.7, 0.5, -0.5);
const BOX_HIGH: DVec3 = DVec3::new(0.6, 1.4, 0.4);

fn box_triangles() -> Vec<[Vec3; 3]> {
    let corner = |i: usize| {
        let pick = |axis: usize| {
            let ends = [BOX_LOW[axis], BOX_HIGH[axis]];
            ends[(i >> axis) & 1] as f32
        };
        Vec3::new(pick(0), pick(1), pick(2))
    };
    let faces: [[usize; 4]; 6] = [
        [0, 2, 6, 4],
        [1, 5, 7, 3],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 1, 3, 2],
        [4, 6, 7, 5],
    ];
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    faces
        .into_iter()
        .flat_map(halves)
        .map(|triangle| triangle.map(corner))
        .collect()
}

/// Whether the sphere is between a point and the light.
fn sphere_blocks(point: DVec3) -> bool {
    let way = LIGHT.as_dvec4().truncate() - point;
    let share = ((CENTRE - point).dot(way) / way.length_squared()).clamp(0.0, 1.0);
    (point + share * way).distance(CENTRE) < RADIUS
}

fn box_blocks(point: DVec3) -> bool {
    let way = LIGHT.as_dvec4().truncate() - point;
    let (one, other) = ((BOX_LOW - point) / way, (BOX_HIGH - point) / way);
    let enters = one.min(other).max_element().max(0.0);
    enters < one.max(other).min_element().min(1.0)
}

/// The sphere's or the box's normal at a point of it.
fn sphere_normal(point: DVec3) -> DVec3 {
    point - CENTRE
}

fn box_normal(point: DVec3) -> DVec3 {
    let middle = 0.5 * (BOX_LOW + BOX_HIGH);
    let offset = (point - middle) / (0.5 * (BOX_HIGH - BOX_LOW));
    let axis = offset.abs().max_position();
    offset.signum() * DVec3::AXES[axis]
}

/// Holds a shot of a convex caster over the floor against the formula for its shadow.
fn check(shot: &Shot, blocks: fn(DVec3) -> bool, normal: fn(DVec3) -> DVec3) {
    let light = LIGHT.as_dvec4().truncate();
    let probe = shot.probe();
    let shadowed = |pixel: usize| {
        let point = probe.point(pixel)?;
        Some(if shot.is_floor(pixel) {
            blocks(point)
        } else {
            normal(point).dot(light - point) <= 0.0
        })
    };
    let formula: Vec<Option<bool>> = (0..WIDTH * HEIGHT).map(shadowed).collect();
    let at_edge = |pixel: usize| {
        let (x, y) = ((pixel % WIDTH) as i64, (pixel / WIDTH) as i64);
        let differs = |dx: i64, dy: i64| {
            let (x, y) = (x + dx, y + dy);
            let inside = (0..WIDTH as i64).contains(&x) && (0..HEIGHT as i64).contains(&y);
            let other = inside.then(|| (y * WIDTH as i64 + x) as usize);
            other.is_some_and(|other| {
                shot.is_floor(other) == shot.is_floor(pixel) && formula[other] != formula[pixel]
            })
        };
        (-1..=1).any(|dy| (-1..=1).any(|dx| differs(dx, dy)))
    };
    let (mut compared, mut in_shadow) = (0, 0);
    for (pixel, (verdict, formula)) in shot.truth.verdicts().zip(&formula).enumerate() {
        let agrees = match (verdict, formula) {
            (Verdict::Background, None) | (Verdict::Ambiguous, _) => true,
            (Verdict::Lit, Some(shadowed)) => !shadowed,
            (Verdict::Shadowed, Some(shadowed)) => *shadowed,
            _ => false,
        };
        assert!(agrees || at_edge(pixel), "{verdict:?} at pixel {pixel}");
        compared += usize::from(formula.is_some());
        in_shadow += usize::from(*formula == Some(true));
    }
    assert!(
        compared > 20_000 && in_shadow > 800,
        "{in_shadow} of {compared}"
    );
    let ambiguous = shot.truth.count(Verdict::Ambiguous);
    assert!(ambiguous * 200 < compared as u64, "{ambiguous} ambiguous");

    let grey = |shadowed: &Option<bool>| if *shadowed == Some(true) { 255 } else { 0 };
    let mask: Vec<u8> = formula.iter().map(grey).collect();
    let error = shot.compare(&mask).error();
    assert_eq!(error.artifact_px, 0, "{error:?}");
    let edge = (0..mask.len()).filter(|&pixel| at_edge(pixel)).count() as u64;
    assert!(error.wrong_px() * 4 < edge, "{error:?} along {edge} pixels");
}

#[test]
fn a_sphere_casts_the_shadow_of_the_formula() {
    check(&Shot::sphere(LIGHT), sphere_blocks, sphere_normal);
}

#[test]
fn a_box_casts_the_shadow_of_the_formula() {
    let scene = Scene::default()
        .cast(&box_triangles())
        .receive(&square(8.0, 0.0));
    let shot = Shot::new(scene, LIGHT, Vec3::new(2.0, 3.0, 4.0));
    check(&shot, box_blocks, box_normal);
    // It is flat: the formula holds to the pixel, but where its outline passes a centre.
    assert!(shot.truth.count(Verdict::Ambiguous) < 4);
}

#[test]
fn hardly_a_pixel_of_the_sphere_grid_is_ambiguous() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/sphere_grid.toml");
    let search = ModelSearch::for_scene_file(&path);
    let scene = SceneFile::read(&path).unwrap().load(&search).unwrap();
    let mesh = &scene.mesh;
    let casters = mesh.casters().map(|object| object.triangle_range());
    let casts: Vec<_> = casters.collect();
    let reference = Reference::new(&mesh.positions, &mesh.triangles, |triangle| {
        casts
            .iter()
            .any(|range| range.contains(&(triangle as usize)))
    })
    .unwrap();
    for time_s in scene.flight.frame_times(6) {
        let view = ReferenceView {
            width: 320,
            height: 240,
            view_projection: scene.flight.at(time_s).view.view_projection(4.0 / 3.0),
        };
        let ids = reference.visible_ids(&view).unwrap();
        let mask = reference
            .trace(scene.flight.at(time_s).light, &view, &ids)
            .unwrap();
        let ambiguous = mask.count(Verdict::Ambiguous);
        assert!(ambiguous * 200 < 320 * 240, "{ambiguous} at {time_s} s");
        assert!(mask.count(Verdict::Shadowed) > 1000);
    }
}
