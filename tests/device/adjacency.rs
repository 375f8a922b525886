//! Volumes of triangles with adjacency: each form where it is right, and where it is not.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use svbench::frame::FrameResources;
use svbench::gpu::Gpu;
use svbench::judge::Verifier;
use svbench::methods::{PrepareContext, Registry};
use svbench::reference::ReferenceCache;
use svbench::scene::Scene;

const LIGHT: Vec4 = Vec4::new(2.0, 9.0, 1.5, 1.0);

/// The four faces of a pyramid of three sides, counter-clockwise seen from outside.
fn pyramid() -> [[Vec3; 3]; 4] {
    let [top, a, b, c] = [
        Vec3::new(0.1, 3.0, 0.2),
        Vec3::new(-1.4, 0.8, 1.1),
        Vec3::new(1.5, 0.9, 0.7),
        Vec3::new(0.2, 0.7, -1.3),
    ];
    [[top, a, b], [top, b, c], [top, c, a], [a, c, b]]
}

/// Artifact pixels, or why there is no picture.
fn artifacts(gpu: &Gpu, scene: &Scene, method: &str) -> Result<u64, String> {
    let stage = FrameResources::new(gpu, scene, 320, 240).unwrap();
    let context = PrepareContext::new(gpu, scene, &stage);
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(gpu, scene, &stage, &cache).unwrap();
    let truth = verifier.truth(&scene.flight.at(0.0)).unwrap();
    let method = Registry::builtin().parse(method).unwrap();
    let mut prepared = method
        .prepare(&context)
        .map_err(|error| error.to_string())?;
    let mask = verifier.draw_mask(prepared.as_mut(), &truth).unwrap();
    let compared = verifier.compare(&mask, &truth, prepared.as_ref()).unwrap();
    Ok(compared.error.artifact_px)
}

#[test]
fn the_two_manifold_form_is_right_on_closed_meshes_alone() {
    let gpu = device();
    let closed = scene_over_ground(&pyramid(), 0.0, LIGHT, &view());
    // Without the face that is turned away most: what faces the light is open, too.
    let open = scene_over_ground(&pyramid()[1..3], 0.0, LIGHT, &view());
    // One of these faces the light from its back.
    let [first, [a, b, c], ..] = pyramid();
    let twisted = scene_over_ground(&[first, [a, c, b]], 0.0, LIGHT, &view());
    for form in ["robust", "auto", "two_manifold", "two_manifold_unchecked"] {
        for agreement in ["reference_edge", "any_corner"] {
            let method = format!("adjacency_gs,mode={form},determinism={agreement}");
            assert_eq!(artifacts(&gpu, &closed, &method), Ok(0), "{method}");
            let on_others = [&open, &twisted].map(|scene| artifacts(&gpu, scene, &method));
            match form {
                "two_manifold" => {
                    for refused in on_others {
                        let reason = refused.unwrap_err();
                        assert!(reason.contains("1 of 1 objects are not closed"), "{reason}");
                        assert!(reason.contains("use mode=auto or robust"), "{reason}");
                    }
                }
                "two_manifold_unchecked" => {
                    let wrong = on_others.map(Result::unwrap);
                    assert!(wrong.iter().any(|px| *px > 100), "{method}: {wrong:?}");
                }
                _ => assert_eq!(on_others, [Ok(0), Ok(0)], "{method}"),
            }
        }
    }
}

#[test]
fn the_robust_form_is_right_where_many_triangles_meet_or_turn_over() {
    let gpu = device();
    let (a, b) = (Vec3::new(-0.1, 1.2, -1.3), Vec3::new(0.2, 1.9, 1.4));
    let page = |i: u32| {
        let (sin, cos) = (0.1 + std::f32::consts::TAU * i as f32 / 7.0).sin_cos();
        let outer = Vec3::new(1.5 * cos, 1.6 + 1.4 * sin, 0.13);
        if i.is_multiple_of(2) {
            [a, b, outer]
        } else {
            [b, a, outer]
        }
    };
    let book: Vec<_> = (0..7).map(page).collect();
    for count in 2..=7 {
        let scene = scene_over_ground(&book[..count], 0.0, LIGHT, &view());
        for method in ["adjacency_gs,mode=robust", "adjacency_gs"] {
            let wrong = artifacts(&gpu, &scene, method).unwrap();
            assert!(wrong <= 1, "{method} with {count} pages: {wrong}");
        }
    }
}

#[test]
fn what_counts_by_the_reference_edge_refuses_any_corner() {
    let gpu = device();
    let scene = scene_over_ground(&pyramid(), 0.0, LIGHT, &view());
    for with in ["counting=z_pass_counted", "plan=auto"] {
        let method = format!("adjacency_gs,determinism=any_corner,{with}");
        let reason = artifacts(&gpu, &scene, &method).unwrap_err();
        assert!(reason.contains("by the reference edge"), "{reason}");
    }
    let both = artifacts(&gpu, &scene, "adjacency_gs,mode=robust,plan=auto").unwrap_err();
    assert!(both.contains("plan=auto decides `mode`"), "{both}");
}
