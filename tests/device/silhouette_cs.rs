//! Silhouettes by compute shaders: the faces are those of the processor's, so the mask is the same to the bit.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use crate::silhouette_cpu::{draw, light_through_elements, scenes};
use svbench::gpu::{Capability, Gpu, GpuOptions};
use svbench::methods::Registry;
use svbench::scene::{Flight, Scene, SphereGrid};
use svbench::stress::find_cause;

/// Parameters that both methods have.
const SHARED: [&str; 8] = [
    "counting=z_fail",
    "plan=auto",
    "casting=all",
    "caps=triangles",
    "caps=triangles,front_cap=in_place",
    "caps=far_triangles,reach=infinity",
    "casting=each_side,counting=z_pass_counted",
    "counting=auto,reach=object,culling=frustum",
];

/// Parameters of this one, which change no pixel.
const OWN: [&str; 4] = [
    "draw_calls=scene",
    "draw_calls=object",
    "extraction=facings",
    "extraction=facings,draw_calls=object",
];

fn assert_same(gpu: &Gpu, scene: &Scene, shared: &str, own: &[&str], frames: usize) {
    let of_processor = draw(gpu, scene, &format!("silhouette_cpu,{shared}"), frames);
    for own in own {
        let drawn = draw(gpu, scene, &format!("silhouette_cs,{shared},{own}"), frames);
        for (frame, (expected, drawn)) in of_processor.iter().zip(&drawn).enumerate() {
            let is_same = expected.0 == drawn.0;
            assert!(is_same, "{}: {shared},{own}, frame {frame}", scene.name);
        }
    }
}

#[test]
fn the_mask_is_that_of_silhouettes_found_on_the_processor() {
    let gpu = device();
    for (number, scene) in scenes().iter().enumerate() {
        for (other, shared) in SHARED.iter().enumerate() {
            // Each pair of parameters meets in some scenes.
            let own = OWN[(number + other) % OWN.len()];
            assert_same(&gpu, scene, shared, &[own], 1);
        }
    }
}

#[test]
fn edges_of_hundreds_of_triangles_count_as_often() {
    let gpu = device();
    for (cause, count) in [("stacked_sheets", 300.0), ("nested_shells", 100.0)] {
        let scene = find_cause(cause).unwrap().scene(count, 0);
        assert_same(&gpu, &scene, "counting=z_fail", &OWN, 1);
    }
}

#[test]
fn faces_that_do_not_fit_are_drawn_in_rounds() {
    let gpu = device();
    let grid = SphereGrid {
        rows: 4,
        columns: 4,
        slices: 60,
        shells: 1,
    };
    let mesh = grid.mesh().unwrap();
    let flight: Flight = light_through_elements().flight;
    let scene = Scene::new("grid".to_owned(), String::new(), mesh, flight);
    for shared in ["casting=all", "plan=auto"] {
        let own = [
            "faces_mib=1",
            "faces_mib=1,draw_calls=object",
            "faces_mib=4",
        ];
        assert_same(&gpu, &scene, shared, &own, 3);
    }
}

#[test]
fn no_native_stage_is_needed() {
    // Only one device at a time, with its messages.
    let _others = device();
    let gpu = Gpu::open(&GpuOptions {
        adapter: std::env::var("SVBENCH_TEST_ADAPTER").ok(),
        validation: true,
        hidden: Capability::ALL
            .iter()
            .copied()
            .filter(|capability| *capability != Capability::StencilBuffer)
            .collect(),
    })
    .unwrap();
    let scene = find_cause("eye_in_volume").unwrap().scene(0.8, 0);
    for method in [
        "silhouette_cs",
        "silhouette_cs,plan=auto",
        "silhouette_vs",
        "silhouette_vs,plan=auto",
    ] {
        let [(_, error)] = &draw(&gpu, &scene, method, 1)[..] else {
            panic!()
        };
        assert_eq!(error.artifact_px, 0, "{method}");
        assert!(error.compared_px > 0, "{method}");
    }
    let mesh_shaders = Registry::builtin();
    let mesh_shaders = mesh_shaders.get("silhouette_ms").unwrap().info;
    let reasons = mesh_shaders.needs.iter().map(|need| gpu.check(*need));
    let reasons: Vec<_> = reasons.filter_map(Result::err).collect();
    assert!(reasons[0].contains("task and mesh shaders"), "{reasons:?}");
    gpu.wait_idle();
}
