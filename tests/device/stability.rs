//! Where methods fail, and where they may not: the causes of failure against theory, and random scenes.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use svbench::judge::{Attempt, Judge};
use svbench::methods::Registry;
use svbench::methods::ShadowMethod;
use svbench::stress::{Finding, find_cause, random};

pub(crate) const SIZE_PX: (u32, u32) = (160, 120);
/// What promises to be exact.
const ROBUST: [&str; 11] = [
    "silhouette_ts",
    "silhouette_gs",
    "silhouette_gs,counting=auto",
    "silhouette_cpu",
    "silhouette_cs",
    "silhouette_ms",
    "silhouette_vs",
    "silhouette_cpu,counting=auto",
    "triangle_ts",
    "triangle_gs",
    "adjacency_gs,mode=robust",
];

fn methods(ids: &[&str]) -> Vec<Box<dyn ShadowMethod>> {
    ids.iter()
        .map(|id| Registry::builtin().parse(id).unwrap())
        .collect()
}

/// Artifact pixels of a method at a value of a cause.
pub(crate) fn artifacts(judge: &Judge, id: &str, cause: &str, value: f64) -> u64 {
    let scene = find_cause(cause).unwrap().scene(value, 0);
    let trial = judge.trial(&scene, &methods(&[id]));
    assert!(trial.attempts[0].drawn().is_some(), "{id} at {cause}");
    trial.attempts[0].artifact_px()
}

/// A sixteenth of the picture: more than all that single pixels could come to.
const MANY_PX: u64 = SIZE_PX.0 as u64 * SIZE_PX.1 as u64 / 16;
const SOME_PX: u64 = 50;

#[test]
fn z_pass_fails_once_the_eye_is_in_a_volume_and_not_before() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    for method in ["silhouette_ts", "silhouette_gs", "triangle_gs"] {
        let z_pass = format!("{method},counting=z_pass");
        let at = |share| artifacts(&judge, &z_pass, "eye_in_volume", share);
        assert_eq!(at(0.0), 0, "{method}: clear of the volume");
        assert!(at(0.5) > MANY_PX, "{method}: the near rectangle is cut");
        assert!(at(1.0) > MANY_PX, "{method}: inside");
        let auto = format!("{method},counting=auto");
        assert!(
            artifacts(&judge, &auto, "eye_in_volume", 1.0) <= 2,
            "{method}"
        );
    }
}

#[test]
fn edges_that_decide_for_themselves_leak_where_a_triangle_is_edge_on() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    for method in ["silhouette_ts", "silhouette_gs"] {
        let none = format!("{method},determinism=none");
        assert!(
            artifacts(&judge, &none, "edge_on", 1.0) > SOME_PX,
            "{method}"
        );
        for determinism in ["reference_edge", "consistent_triangle"] {
            let sound = format!("{method},determinism={determinism}");
            for value in [0.0, 1.0, 8.0] {
                assert_eq!(
                    artifacts(&judge, &sound, "edge_on", value),
                    0,
                    "{sound} {value}"
                );
            }
        }
    }
}

#[test]
fn a_counter_of_eight_bits_is_zero_again_at_256() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    // Mesh shaders are slow on a processor; tests of counters have them count as far.
    for method in ROBUST.iter().filter(|id| **id != "silhouette_ms") {
        // An open sheet is counted once, a closed shell twice: on its way in and on its way out. Where only triangles
        // that face the light cast, once.
        let casts_once = ["silhouette_c", "silhouette_vs"]
            .iter()
            .any(|id| method.starts_with(id));
        let shells = if casts_once { 256.0 } else { 128.0 };
        for (cause, wraps_at) in [("stacked_sheets", 256.0), ("nested_shells", shells)] {
            let at = |count: f64| artifacts(&judge, method, cause, count);
            assert!(at(wraps_at - 2.0) <= 5, "{method}, {cause}: before");
            assert!(at(wraps_at) > SOME_PX, "{method}, {cause}: at {wraps_at}");
            assert!(at(2.0 * wraps_at) > SOME_PX, "{method}, {cause}: again");
            assert!(at(2.0 * wraps_at - 2.0) <= 5, "{method}, {cause}: between");
        }
    }
}

#[test]
fn a_map_without_bias_shadows_itself() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    let px = u64::from(SIZE_PX.0 * SIZE_PX.1);
    for method in ["shadow_map", "cube_shadow_map"] {
        let of = |bias: &str| {
            let id = format!("{method},resolution=1024,{bias}");
            artifacts(&judge, &id, "scale_up", 0.0)
        };
        let without = of("slope_bias=0.0,constant_bias=0");
        assert!(without > px / 10, "{method}: {without}");
        let with = of("slope_bias=2.0");
        assert!(with < px / 200, "{method}: {with}");
    }
}

/// Draws random scenes with every robust method, and fails on what none of their limits explains. Gives how many
/// pixels were in shadow.
pub(crate) fn assert_sound(judge: &Judge, seeds: impl Iterator<Item = u64>) -> usize {
    let methods = methods(&ROBUST);
    let mut faults = Vec::new();
    let mut shadowed = 0;
    for seed in seeds {
        let trial = judge.trial(&random::case(seed), &methods);
        shadowed += trial
            .truth
            .unwrap()
            .to_grey()
            .iter()
            .filter(|v| **v == 255)
            .count();
        for (method, attempt) in methods.iter().zip(&trial.attempts) {
            let Attempt::Drawn(drawn) = attempt else {
                panic!("{} is unavailable", method.info().id)
            };
            if let Finding::Undeclared = Finding::of(method.as_ref(), None, drawn) {
                let id = method.info().id;
                faults.push(format!("seed {seed}, {id}: {:?}", drawn.judgement.error));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    shadowed
}

#[test]
fn random_scenes_bring_no_robust_method_down() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    let shadowed = assert_sound(&judge, 20_000..20_080);
    // The scenes are not trivial.
    assert!(shadowed > 80 * 2000, "{shadowed}");
}

#[test]
fn a_wrong_method_does_not_survive_random_scenes() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    let wrong = methods(&["silhouette_gs,counting=z_pass"]);
    let is_wrong = |seed: &u64| {
        let trial = judge.trial(&random::case(*seed), &wrong);
        trial.attempts[0].artifact_px() > 0
    };
    let wrong = (0..40).filter(is_wrong).count();
    assert!((4..40).contains(&wrong), "{wrong} of 40");
}
