//! Counts beyond the stencil: where eight bits suffice they give the same mask, and they go on where those are 0 again.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use crate::silhouette_cpu::{draw, scenes};
use crate::stability::artifacts;
use svbench::judge::Judge;

/// What has native stages has the last one as well.
const COUNTERS: [&str; 3] = [
    "counter=blend16",
    "counter=blend32",
    "counter=stencil_export",
];

/// One of those that a method has.
fn counter_of(method: &str, number: usize) -> &'static str {
    let is_portable = ["_cpu", "_cs", "_vs"]
        .iter()
        .any(|how| method.contains(how));
    COUNTERS[number % if is_portable { 2 } else { 3 }]
}

const VARIANTS: [&str; 15] = [
    "silhouette_gs",
    "silhouette_gs,input=storage,casting=light_facing",
    "silhouette_ts,counting=auto",
    "silhouette_ms,plan=auto",
    "silhouette_vs",
    "silhouette_vs,plan=auto",
    "silhouette_cs,casting=all",
    "triangle_gs",
    "triangle_ts,passes=1",
    "triangle_ts,front_cap=in_place",
    "silhouette_cpu",
    "silhouette_cpu,counting=z_pass_counted,casting=each_side",
    "silhouette_cpu,caps=triangles,front_cap=in_place",
    "silhouette_cs,plan=auto",
    "silhouette_cs,faces_mib=1,casting=all",
];

#[test]
fn small_counts_are_those_of_the_stencil() {
    let gpu = device();
    for (number, scene) in scenes().iter().enumerate() {
        // Each variant meets every fifth scene, and there both counters in turn.
        let variants = VARIANTS.iter().enumerate();
        for (other, variant) in variants.filter(|(other, _)| (number + other) % 5 == 0) {
            let counter = counter_of(variant, (number + other) / 5);
            let by_stencil = draw(&gpu, scene, variant, 1);
            let blended = draw(&gpu, scene, &format!("{variant},{counter}"), 1);
            let pixels = by_stencil[0].0.iter().zip(&blended[0].0);
            let different = pixels.filter(|(one, other)| one != other).count();
            assert_eq!(different, 0, "{}: {variant},{counter}", scene.name);
        }
    }
}

#[test]
fn counts_may_go_beyond_eight_bits() {
    let gpu = device();
    let judge = Judge::new(&gpu, (160, 120));
    for (method, counter) in [
        ("silhouette_gs", "counter=blend16"),
        ("silhouette_gs", "counter=stencil_export"),
        ("silhouette_ts", "counter=blend32"),
        ("silhouette_ts", "counter=stencil_export"),
        ("silhouette_ms", "counter=blend16"),
        ("silhouette_ms", "counter=stencil_export"),
        ("silhouette_vs", "counter=blend32"),
        ("silhouette_cpu", "counter=blend16"),
        ("silhouette_cs", "counter=blend32"),
        ("silhouette_cs,casting=all", "counter=blend16"),
    ] {
        for (cause, counts) in [
            ("stacked_sheets", [256.0, 600.0]),
            ("nested_shells", [256.0, 300.0]),
        ] {
            for count in counts {
                let wrong = artifacts(&judge, &format!("{method},{counter}"), cause, count);
                assert!(wrong <= 5, "{method},{counter}: {wrong} at {cause} {count}");
            }
            let wraps = artifacts(&judge, method, cause, counts[0]);
            assert!(wraps > 100, "{method}: {wraps} at {cause} {}", counts[0]);
        }
    }
}
