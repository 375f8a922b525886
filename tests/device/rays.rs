//! Whether a triangle blocks the light of a point, asked by rays, by a map without aliasing and by frusta of triangles: against
//! the truth and against each other.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use crate::accuracy::random_shot;
use crate::common::{device, scene_over_ground, view};
use crate::silhouette_cpu::draw;
use crate::stability::{SIZE_PX, artifacts};
use glam::Vec4;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use svbench::config::find_scene;
use svbench::frame::FrameResources;
use svbench::gpu::{Capability, Gpu, GpuOptions};
use svbench::judge::{Judge, Verifier};
use svbench::methods::{PrepareContext, Registry};
use svbench::reference::ReferenceCache;
use svbench::scene::{Moment, Scene};
use svbench::stress::find_cause;

const EXACT: [&str; 7] = [
    "ray_cpu",
    "ray_compute",
    "alias_free_map",
    "alias_free_map,lists=sorted,resolution=96",
    "triangle_frusta",
    "triangle_frusta,slices=1",
    "ray_query,primitives=boxes",
];
const TRIANGLES: &str = "ray_query";

/// Artifact pixels of each picture by each method, and how many pixels of each mask differ from the first method's.
fn errors(
    scene: &Scene,
    (width, height): (u32, u32),
    shots: &[Moment],
    methods: &[&str],
) -> Vec<Vec<(u64, usize)>> {
    let gpu = device();
    let stage = FrameResources::new(&gpu, scene, width, height).unwrap();
    let context = PrepareContext::new(&gpu, scene, &stage);
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(&gpu, scene, &stage, &cache).unwrap();
    let prepare = |id: &&str| {
        let method = Registry::builtin().parse(id).unwrap();
        method.prepare(&context).unwrap()
    };
    let mut methods: Vec<_> = methods.iter().map(prepare).collect();
    let of_shot = |moment: &Moment| {
        let truth = verifier.truth(moment).unwrap();
        let mut first = None;
        let mut row = Vec::new();
        for method in &mut methods {
            let mask = verifier.draw_mask(method.as_mut(), &truth).unwrap();
            let judgement = verifier.compare(&mask, &truth, method.as_ref()).unwrap();
            let first = first.get_or_insert_with(|| mask.clone());
            let differ = mask
                .iter()
                .zip(first)
                .filter(|(one, other)| **one != **other);
            row.push((judgement.error.artifact_px, differ.count()));
        }
        row
    };
    shots.iter().map(of_shot).collect()
}

#[test]
fn rays_at_spheres_are_exact_and_agree() {
    // One of them fills neither words of the mask nor workgroups.
    for (slices, size_px) in [(18, (640, 480)), (60, (611, 397))] {
        let plan = find_scene("sphere_grid", Path::new("")).unwrap();
        let file = plan.file.with_sphere_grid(None, None, Some(slices));
        let scene = file.unwrap().load(&plan.search).unwrap();
        let path = scene.flight.at(0.0).view;
        let mut random = ChaCha8Rng::seed_from_u64(16);
        // The light moves from picture to picture.
        let shots: Vec<_> = (0..6).map(|_| random_shot(&mut random, path)).collect();
        let methods = [&EXACT[..], &[TRIANGLES]].concat();
        for (shot, row) in errors(&scene, size_px, &shots, &methods).iter().enumerate() {
            for (method, (artifact_px, differ_px)) in methods.iter().zip(row) {
                let most = if *method == TRIANGLES { 1 } else { 0 };
                assert!(
                    *artifact_px <= most,
                    "{method}, {slices} slices, shot {shot}: {row:?}"
                );
                assert!(
                    *differ_px <= 8,
                    "{method}, {slices} slices, shot {shot}: {row:?}"
                );
            }
        }
    }
}

#[test]
fn rays_in_sponza_err_by_a_pixel_at_most() {
    let plan = find_scene("sponza", Path::new("")).unwrap();
    let scene = match plan.file.load(&plan.search) {
        Ok(scene) => scene,
        Err(error) => return println!("skipped: {error}"),
    };
    let shots: Vec<_> = [5.0, 17.0, 29.0].map(|at| scene.flight.at(at)).into();
    let methods = [&EXACT[..5], &[TRIANGLES]].concat();
    let errors = errors(&scene, (640, 480), &shots, &methods);
    for (number, method) in methods.iter().enumerate() {
        let artifact_px: u64 = errors.iter().map(|row| row[number].0).sum();
        assert!(
            artifact_px as f64 <= 1.25 * shots.len() as f64,
            "{method}: {errors:?}"
        );
    }
}

#[test]
fn no_number_of_surfaces_is_too_many_for_a_ray() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    for (cause, value) in [
        ("nested_shells", 300.0),
        ("stacked_sheets", 600.0),
        ("fan", 512.0),
    ] {
        for method in [&EXACT[..], &[TRIANGLES]].concat() {
            assert_eq!(
                artifacts(&judge, method, cause, value),
                0,
                "{method}, {cause}"
            );
        }
    }
}

#[test]
fn a_scene_without_casters_has_no_shadow() {
    let gpu = device();
    let mut scene = scene_over_ground(&[], 0.0, Vec4::new(1.0, 5.0, 2.0, 1.0), &view());
    let mut mesh = (*scene.mesh).clone();
    mesh.objects
        .iter_mut()
        .for_each(|object| object.casts_shadow = false);
    scene.mesh = mesh.into();
    for method in [&EXACT[..], &[TRIANGLES]].concat() {
        let [(mask, error)] = &draw(&gpu, &scene, method, 1)[..] else {
            panic!()
        };
        assert!(
            error.compared_px > 0 && mask.iter().all(|pixel| *pixel == 0),
            "{method}"
        );
    }
}

/// Where flaws are: of the mesh, the light, and the eye.
#[test]
fn rays_are_robust() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    for cause in [
        "collinear",
        "edge_on",
        "eye_in_volume",
        "klein_bottle",
        "light_in_mesh",
        "needles",
        "thin_wall",
    ] {
        let worst = *find_cause(cause).unwrap().values.last().unwrap();
        for method in EXACT {
            let artifact_px = artifacts(&judge, method, cause, worst);
            assert_eq!(artifact_px, 0, "{method}, {cause} {worst}");
        }
    }
}

#[test]
fn rays_need_no_capability_but_ray_queries() {
    // Only one device at a time, with its messages.
    let _others = device();
    let gpu = Gpu::open(&GpuOptions {
        adapter: std::env::var("SVBENCH_TEST_ADAPTER").ok(),
        validation: true,
        hidden: Capability::ALL.to_vec(),
    })
    .unwrap();
    let scene = find_cause("eye_in_volume").unwrap().scene(0.8, 0);
    for method in &EXACT[..6] {
        let [(_, error)] = &draw(&gpu, &scene, method, 1)[..] else {
            panic!()
        };
        assert_eq!(error.artifact_px, 0, "{method}");
        assert!(error.compared_px > 0, "{method}");
    }
    let registry = Registry::builtin();
    let reason = registry
        .get(TRIANGLES)
        .unwrap()
        .info
        .check(&gpu)
        .unwrap_err();
    assert!(reason.contains("ray queries"), "{reason}");
    gpu.wait_idle();
}

/// A bias that no surface needs: the higher it is, the more light comes through under the spheres of a grid.
#[test]
fn bias_lets_light_through() {
    let plan = find_scene("sphere_grid", Path::new("")).unwrap();
    let file = plan.file.with_sphere_grid(None, None, Some(18)).unwrap();
    let scene = file.load(&plan.search).unwrap();
    let shots = [scene.flight.at(3.0)];
    let methods = [
        "triangle_frusta",
        "triangle_frusta,bias=0.002",
        "triangle_frusta,bias=0.01",
    ];
    let errors = errors(&scene, (320, 240), &shots, &methods);
    let [(none, _), (some, _), (more, _)] = errors[0][..] else {
        panic!()
    };
    assert!(none == 0 && some > 0 && more > some, "{errors:?}");
}

/// A light at infinity has one face, a lamp six: seen from within, and with what the map is cut to as small as it gets.
#[test]
fn maps_hold_samples_on_all_faces() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    for (cause, value) in [
        ("light_at_infinity", 60.0),
        ("light_in_lantern", 1.0),
        ("light_in_mesh", 0.75),
        ("light_near_face", 5.0),
        ("light_distance", 10.0),
    ] {
        for method in [
            "alias_free_map,resolution=32",
            "alias_free_map,resolution=1024",
        ] {
            assert_eq!(
                artifacts(&judge, method, cause, value),
                0,
                "{method}, {cause} {value}"
            );
        }
    }
}
