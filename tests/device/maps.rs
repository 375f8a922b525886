//! Shadow maps by their default bias: no surface shadows itself, wherever the scene is and wherever the light.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use glam::{Vec3, Vec4};
use svbench::judge::Judge;
use svbench::methods::Registry;
use svbench::metrics::{Label, MaskError};
use svbench::scene::{CameraKey, CameraPath, Flight, Light, Part, Scene};

const SIZE_PX: (u32, u32) = (320, 240);
const MAPS: [&str; 3] = ["shadow_map", "shadow_map,resolution=512", "cube_shadow_map"];

/// A box `height` over a floor, both of which cast. `turn` puts axes in other places: their sides stay along axes.
fn box_over_floor(height: f32, turn: fn(Vec3) -> Vec3, offset: Vec3, light: Vec4) -> Scene {
    let place = |p: Vec3| turn(p) + offset;
    let quad = |corners: [[f32; 3]; 4]| {
        let [a, b, c, d] = corners.map(|p| place(Vec3::from_array(p)));
        [[a, b, c], [a, c, d]]
    };
    let (x0, x1, y0, y1) = (-1.0, 1.0, height, height + 1.0);
    let faces = [
        [[x0, y0, x0], [x1, y0, x0], [x1, y0, x1], [x0, y0, x1]],
        [[x0, y1, x0], [x0, y1, x1], [x1, y1, x1], [x1, y1, x0]],
        [[x0, y0, x0], [x0, y1, x0], [x1, y1, x0], [x1, y0, x0]],
        [[x0, y0, x1], [x1, y0, x1], [x1, y1, x1], [x0, y1, x1]],
        [[x0, y0, x0], [x0, y0, x1], [x0, y1, x1], [x0, y1, x0]],
        [[x1, y0, x0], [x1, y1, x0], [x1, y1, x1], [x1, y0, x1]],
    ];
    let floor = quad([
        [-5.0, 0.0, -5.0],
        [-5.0, 0.0, 5.0],
        [5.0, 0.0, 5.0],
        [5.0, 0.0, -5.0],
    ]);
    let mesh = [
        Part::of_triangles("floor", &floor),
        Part::of_triangles("box", &faces.map(quad).concat()),
    ];
    let camera = CameraPath {
        keys: vec![CameraKey {
            time_s: 0.0,
            eye: place(Vec3::splat(6.0)),
            target: place(Vec3::ZERO),
        }],
        up: turn(Vec3::Y),
        fov_y_rad: 0.9,
        near: 0.1,
    };
    let light = if light.w == 0.0 {
        turn(light.truncate()).extend(0.0)
    } else {
        place(light.truncate()).extend(1.0)
    };
    Scene::new(
        "box".to_owned(),
        "box".to_owned(),
        mesh.into_iter().collect(),
        Flight::under(Light::at(light), camera),
    )
}

/// The errors of a method, and how many pixels of them are acne; there is a shadow at all.
fn errors(judge: &Judge, scene: &Scene, method: &str) -> (MaskError, u64) {
    let trial = judge.trial(scene, &[Registry::builtin().parse(method).unwrap()]);
    let truth = trial.truth.as_ref().unwrap().to_grey();
    let shadowed = truth.iter().filter(|v| **v == 255).count();
    assert!(shadowed > 500, "{shadowed}");
    let judgement = &trial.attempts[0].drawn().unwrap().judgement;
    (judgement.error, judgement.analysis.label_px(Label::Acne))
}

/// The light's depth of a floor that faces it squarely does not change, and no slope takes rounding away.
#[test]
fn a_floor_square_to_the_light_does_not_shadow_itself() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    let turns: [fn(Vec3) -> Vec3; 4] = [
        |p| p,
        |p| -p,
        |p| Vec3::new(p.y, p.z, p.x),
        |p| Vec3::new(-p.z, -p.x, -p.y),
    ];
    let lights = [
        Vec4::new(0.0, 8.0, 0.0, 1.0),
        Vec4::new(0.0, 31.7, 0.0, 1.0),
        Vec4::new(0.0, 5000.0, 0.0, 1.0),
        Vec4::new(0.0, 1.0, 0.0, 0.0),
    ];
    for turn in turns {
        for light in lights {
            let scene = box_over_floor(1.0, turn, Vec3::ZERO, light);
            for map in &MAPS[..2] {
                let (error, _) = errors(&judge, &scene, map);
                assert_eq!(error.artifact_px, 0, "{map} under {light}: {error:?}");
            }
        }
    }
}

#[test]
fn no_scene_is_so_far_from_the_origin_that_its_surfaces_shadow_themselves() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    for direction in [Vec3::X, Vec3::NEG_Y, Vec3::new(1.0, 1.0, -1.0)] {
        for distance in [256.0, 4096.0, 65536.0] {
            for light in [[0.0, 8.0, 0.0], [3.0, 7.0, 1.0]] {
                let light = Vec3::from_array(light).extend(1.0);
                let scene = box_over_floor(1.0, |p| p, distance * direction, light);
                for map in MAPS {
                    let (error, acne_px) = errors(&judge, &scene, map);
                    let place = format!("{map} at {distance} × {direction}: {error:?}");
                    assert!(acne_px <= 2 && error.artifact_px <= 4, "{place}");
                    assert!(error.wrong_px() < 150, "{place}");
                }
            }
        }
    }
}

/// The bias is a length of the order of rounding: where the box stands on the floor, so does its shadow.
#[test]
fn the_default_bias_detaches_no_shadow() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    for light in [
        Vec4::new(-3.0, 7.0, -2.0, 1.0),
        Vec4::new(-0.4, 1.0, -0.3, 0.0),
    ] {
        let scene = box_over_floor(0.0, |p| p, Vec3::ZERO, light);
        let (error, _) = errors(&judge, &scene, "shadow_map");
        assert!(error.artifact_px <= 2, "{light}: {error:?}");
    }
}
