//! Whatever is not declared to clash goes together: each way to find silhouettes with each counter, way of counting and plan.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use crate::silhouette_cpu::draw;
use crate::stability::SIZE_PX;
use svbench::frame::FrameResources;
use svbench::judge::Judge;
use svbench::methods::{self, Domain, Effect, Parameter, PrepareContext, Registration, Registry};
use svbench::stress::find_cause;

const WAYS: [&str; 4] = [
    "plan=auto",
    "counting=z_fail",
    "counting=z_pass",
    "counting=z_pass_counted",
];

fn volume_methods(registry: &Registry) -> impl Iterator<Item = &Registration> {
    registry
        .iter()
        .filter(|known| !known.info.clashes.is_empty())
}

fn counters(known: &Registration) -> Vec<&'static str> {
    let counter = |parameter: &&Parameter| parameter.name == "counter";
    let found = known.parameters.iter().find(counter).unwrap();
    let Domain::Choice { choices } = &found.domain else {
        panic!("{found:?}")
    };
    choices.to_vec()
}

#[test]
fn what_is_refused_beside_another_is_declared() {
    let gpu = device();
    let scene = find_cause("light_in_mesh").unwrap().scene(0.2, 0);
    let usual = FrameResources::new(&gpu, &scene, 64, 64).unwrap();
    let registry = Registry::builtin();
    let mut refused = 0;
    for known in volume_methods(&registry) {
        let id = known.info.id;
        let clashes = known.info.clashes.iter();
        let of_plan = clashes.filter(|clash| clash.effect == Effect::Refused);
        let declared: Vec<_> = of_plan
            .flat_map(|clash| clash.of(&known.parameters))
            .collect();
        for parameter in &known.parameters {
            let Domain::Choice { choices } = &parameter.domain else {
                continue;
            };
            let default = parameter.default_text();
            let others = choices.iter().filter(|choice| **choice != default);
            for choice in others.filter(|_| parameter.name != "plan") {
                let text = format!("{id},plan=auto,{}={choice}", parameter.name);
                let method = registry.parse(&text).unwrap();
                let stage = usual.with_depth(&gpu, method.depth_setup()).unwrap();
                let context = PrepareContext::new(&gpu, &scene, &stage);
                let is_refused = methods::prepare(method.as_ref(), &context).is_err();
                let named = format!("{}={choice}", parameter.name);
                let is_declared = declared
                    .iter()
                    .any(|own| *own == parameter.name || **own == named);
                assert_eq!(is_refused, is_declared, "{text}");
                refused += usize::from(is_refused);
            }
        }
    }
    assert!(refused > 50, "{refused}");
}

#[test]
fn each_extraction_goes_with_each_counter_and_way_of_counting() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    let scene = find_cause("light_in_mesh").unwrap().scene(0.2, 0);
    let registry = Registry::builtin();
    let mut all = Vec::new();
    for known in volume_methods(&registry) {
        for counter in counters(known) {
            for way in WAYS {
                let method = format!("{},{way},counter={counter}", known.info.id);
                all.push(registry.parse(&method).unwrap());
            }
        }
    }
    // Six methods of native stages with four counters each, three others with three.
    assert_eq!(all.len(), (6 * 4 + 3 * 3) * WAYS.len());
    let trial = judge.trial(&scene, &all);
    for (method, attempt) in all.iter().zip(&trial.attempts) {
        assert!(attempt.drawn().is_some(), "{}", method.name());
        assert_eq!(attempt.artifact_px(), 0, "{}", method.name());
    }
}

#[test]
fn what_is_ignored_beside_another_changes_no_pixel() {
    let gpu = device();
    let scene = find_cause("eye_in_volume").unwrap().scene(0.8, 0);
    let registry = Registry::builtin();
    for known in volume_methods(&registry) {
        let clashes = known.info.clashes.iter();
        for clash in clashes.filter(|clash| clash.effect == Effect::Ignored) {
            let (name, value) = clash.beside;
            let casting = known.parameters.iter().any(|own| own.name == "casting");
            let all = if casting {
                "casting=all"
            } else {
                "mode=robust"
            };
            let beside = format!("{},{all},{name}={value}", known.info.id);
            let expected = &draw(&gpu, &scene, &beside, 1)[0].0;
            for parameter in clash.of(&known.parameters) {
                let set = match parameter {
                    "caps" => "caps=far_triangles",
                    "front_cap" => "front_cap=in_place",
                    _ => parameter,
                };
                let method = format!("{},{name}={value},{set}", known.info.id);
                let method = match set.contains("casting") {
                    true => method,
                    false => format!("{method},{all}"),
                };
                assert!(draw(&gpu, &scene, &method, 1)[0].0 == *expected, "{method}");
            }
        }
    }
}
