//! Silhouettes by task and mesh shaders: however edges are grouped, the faces are the same, so the mask is to the bit.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use crate::silhouette_cpu::{draw, light_through_elements, scenes};
use svbench::stress::{find_cause, random};

#[test]
fn however_edges_are_grouped_the_mask_is_the_same() {
    let gpu = device();
    // The last cluster of this one is not full.
    let scenes = scenes().into_iter().chain([random::case(20_139)]);
    for (number, scene) in scenes.enumerate() {
        let shared = ["counting=z_fail", "plan=auto", "casting=light_facing"][number % 3];
        let drawn = |edges: u32| {
            let method = format!("silhouette_ms,{shared},edges_per_task={edges}");
            draw(&gpu, &scene, &method, 1)
        };
        let expected = drawn(128);
        assert_eq!(expected[0].1.artifact_px, 0, "{}: {shared}", scene.name);
        for edges in [1, 7, 32] {
            let is_same = drawn(edges)[0].0 == expected[0].0;
            assert!(is_same, "{}: {shared}, {edges} edges a task", scene.name);
        }
    }
}

/// More quads than a workgroup makes, of one edge and of many.
#[test]
fn edges_of_hundreds_of_triangles_count_as_often() {
    let gpu = device();
    for (cause, count) in [("stacked_sheets", 200.0), ("nested_shells", 100.0)] {
        let scene = find_cause(cause).unwrap().scene(count, 0);
        for edges in [1, 128] {
            let method = format!("silhouette_ms,edges_per_task={edges}");
            let [(_, error)] = &draw(&gpu, &scene, &method, 1)[..] else {
                panic!()
            };
            assert_eq!(error.artifact_px, 0, "{cause}, {edges} edges a task");
        }
    }
}

#[test]
fn clusters_that_a_light_leaves_out_have_no_silhouette() {
    let gpu = device();
    let scene = light_through_elements();
    let drawn = draw(&gpu, &scene, "silhouette_ms,edges_per_task=1", 11);
    for (frame, (_, error)) in drawn.iter().enumerate() {
        assert_eq!(error.artifact_px, 0, "frame {frame}");
    }
}
