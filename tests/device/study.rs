//! What may be varied for study, and what theory says of it: the depth buffer, the front caps, filtered maps;
//! and that the truth decides nearly everything.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use std::path::Path;
use svbench::config::{builtin_scenes, find_scene};
use svbench::frame::FrameResources;
use svbench::gpu::Gpu;
use svbench::judge::Verifier;
use svbench::methods::{PrepareContext, Registry};
use svbench::metrics::{Label, MaskError};
use svbench::reference::ReferenceCache;
use svbench::scene::{Scene, SceneError, View};

const SIZE_PX: (u32, u32) = (320, 240);
const VOLUMES: [&str; 6] = [
    "silhouette_ts",
    "silhouette_gs",
    "silhouette_cpu",
    "triangle_ts",
    "triangle_ts,passes=1",
    "triangle_gs",
];

/// One frame of a method.
struct Drawn {
    mask: Vec<u8>,
    error: MaskError,
    acne_px: u64,
}

/// The frame at a time on the scene's flight.
fn draw(gpu: &Gpu, scene: &Scene, method: &str, time_s: f64) -> Drawn {
    let method = Registry::builtin().parse(method).unwrap();
    let depth = method.depth_setup();
    depth.check(gpu).unwrap();
    let stage = FrameResources::new(gpu, scene, SIZE_PX.0, SIZE_PX.1)
        .unwrap()
        .with_depth(gpu, depth)
        .unwrap();
    let context = PrepareContext::new(gpu, scene, &stage);
    let mut prepared = method.prepare(&context).unwrap();
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(gpu, scene, &stage, &cache).unwrap();
    let truth = verifier.truth(&scene.flight.at(time_s)).unwrap();
    let mask = verifier.draw_mask(prepared.as_mut(), &truth).unwrap();
    let judgement = verifier.compare(&mask, &truth, prepared.as_ref()).unwrap();
    Drawn {
        error: judgement.error,
        acne_px: judgement.analysis.label_px(Label::Acne),
        mask,
    }
}

fn builtin(name: &str) -> Scene {
    let plan = find_scene(name, Path::new("")).unwrap();
    let file = match name {
        "sphere_grid" => plan.file.with_sphere_grid(None, None, Some(18)).unwrap(),
        _ => plan.file,
    };
    file.load(&plan.search).unwrap()
}

#[test]
fn every_depth_buffer_gives_the_same_shadows() {
    let gpu = device();
    let scene = builtin("sphere_grid");
    for method in VOLUMES {
        for depth in [
            "depth=reversed",
            "depth=standard",
            "depth_format=unorm24",
            "depth=standard,depth_format=unorm24",
            "depth=standard,reach=infinity",
            "depth=standard,counting=auto",
        ] {
            let drawn = draw(&gpu, &scene, &format!("{method},{depth}"), 4.0);
            let shadowed = drawn.mask.iter().filter(|value| **value != 0).count();
            assert!(shadowed > 5000, "{method},{depth}: {shadowed}");
            let error = drawn.error;
            assert!(error.wrong_px() <= 25, "{method},{depth}: {error:?}");
            assert!(error.artifact_px <= 10, "{method},{depth}: {error:?}");
        }
    }
}

#[test]
fn a_near_plane_close_to_the_eye_costs_standard_depth_its_precision() {
    let gpu = device();
    let scene = builtin("sphere_grid");
    let wrong = |depth: &str| {
        let method = format!("silhouette_gs,near=0.0005,depth={depth}");
        draw(&gpu, &scene, &method, 4.0).error.wrong_px()
    };
    let (reversed, standard) = (wrong("reversed"), wrong("standard"));
    assert!(reversed <= 3 && standard > 50, "{reversed}, {standard}");
}

#[test]
fn front_caps_in_place_have_acne_unless_pushed_back() {
    let gpu = device();
    let scene = builtin("sphere_grid");
    let drawn = |method: &str| draw(&gpu, &scene, method, 4.0);
    for method in ["silhouette_ts", "silhouette_gs", "triangle_gs"] {
        let in_place = drawn(&format!("{method},front_cap=in_place,push_back_px=0"));
        assert!(in_place.acne_px > 200, "{method}: {:?}", in_place.error);
        let pushed = drawn(&format!("{method},front_cap=in_place,push_back_px=0.01"));
        assert!(
            pushed.error.artifact_px < 30,
            "{method}: {:?}",
            pushed.error
        );
    }
}

/// The corners of an upright card.
fn card(left: Vec3, right: Vec3, height: f32) -> [[Vec3; 3]; 2] {
    let up = Vec3::Y * height;
    [[left, right, right + up], [right + up, left + up, left]]
}

#[test]
fn a_filtered_map_has_grey_edges_and_thresholds_to_the_plain_shadow() {
    let gpu = device();
    let light = Vec4::new(2.0, 9.0, 1.5, 1.0);
    let caster = card(Vec3::new(-2.0, 1.0, 0.0), Vec3::new(1.5, 1.0, 0.4), 1.5);
    let scene = scene_over_ground(&caster, 0.0, light, &view());
    for map in ["shadow_map", "cube_shadow_map"] {
        let drawn = |pcf: u32| {
            let method = format!("{map},resolution=512,pcf={pcf}");
            draw(&gpu, &scene, &method, 0.0)
        };
        let greys = |drawn: &Drawn| {
            let grey = |value: &&u8| (1..255).contains(*value);
            drawn.mask.iter().filter(grey).count()
        };
        let (plain, filtered, wide) = (drawn(1), drawn(3), drawn(7));
        assert_eq!(greys(&plain), 0, "{map}");
        assert!(greys(&filtered) > 50, "{map}: {}", greys(&filtered));
        assert!(greys(&wide) > greys(&filtered), "{map}");
        let difference = plain.mask.iter().zip(&filtered.mask);
        // Averaging may round corners, but moves no edge by more than a texel.
        let moved = difference.filter(|(a, b)| (**a >= 128) != (**b >= 128));
        assert!(moved.count() < greys(&filtered), "{map}");
        assert!(filtered.error.artifact_px <= plain.error.artifact_px + 20);
    }
}

#[test]
fn a_filtered_cube_has_no_seams() {
    // A lamp low over the ground: the edge between its faces down and sideways crosses the shadows.
    let gpu = device();
    let light = Vec4::new(0.0, 2.0, 0.0, 1.0);
    let cards: Vec<_> = [(1.0, 0.0), (-1.0, 0.3), (0.2, 1.0)]
        .into_iter()
        .flat_map(|(x, z)| {
            let at = Vec3::new(x, 0.6, z);
            card(at, at + Vec3::new(-0.4 * z, 0.0, 0.4 * x), 0.5)
        })
        .collect();
    let view = View {
        eye: Vec3::new(0.5, 7.0, 3.0),
        ..view()
    };
    let scene = scene_over_ground(&cards, 0.0, light, &view);
    let drawn = draw(&gpu, &scene, "cube_shadow_map,resolution=1024,pcf=9", 0.0);
    assert!(drawn.error.artifact_px <= 10, "{:?}", drawn.error);
    // On the open ground the filter finds nothing, on whatever face its texels are.
    let bare = scene_over_ground(&[], 0.0, light, &view);
    let drawn = draw(&gpu, &bare, "cube_shadow_map,resolution=64,pcf=15", 0.0);
    assert!(drawn.mask.iter().all(|value| *value == 0));
}

#[test]
fn a_bias_is_not_searched_for_outside_of_runs() {
    let gpu = device();
    let scene = builtin("sphere_grid");
    let stage = FrameResources::new(&gpu, &scene, 8, 8).unwrap();
    let context = PrepareContext::new(&gpu, &scene, &stage);
    let method = Registry::builtin()
        .parse("shadow_map,slope_bias=search")
        .unwrap();
    let reason = method.prepare(&context).err().unwrap().to_string();
    assert!(reason.contains("give a number"), "{reason}");
}

#[test]
fn hardly_a_pixel_of_any_scene_is_ambiguous() {
    let gpu = device();
    let cache = ReferenceCache::open(None);
    for name in builtin_scenes() {
        let plan = find_scene(name, Path::new("")).unwrap();
        let scene = match plan.file.load(&plan.search) {
            Err(SceneError::MissingModel { .. }) => continue,
            scene => scene.unwrap(),
        };
        let stage = FrameResources::new(&gpu, &scene, SIZE_PX.0, SIZE_PX.1).unwrap();
        let verifier = Verifier::new(&gpu, &scene, &stage, &cache).unwrap();
        for part in [0.1, 0.35, 0.6, 0.85] {
            let time_s = part * scene.flight.duration_s();
            let truth = verifier.truth(&scene.flight.at(time_s)).unwrap();
            let ambiguous = truth.mask.to_grey().iter().filter(|v| **v == 128).count();
            let limit = (SIZE_PX.0 * SIZE_PX.1) as usize / 200;
            assert!(ambiguous < limit, "{name} at {time_s} s: {ambiguous}");
        }
    }
}
