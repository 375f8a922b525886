//! Limits are tests that must fail: each cause that a method declares to fail is drawn, and something is wrong. A
//! limit that no longer holds is to be taken out.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use crate::stability::SIZE_PX;
use std::collections::BTreeMap;
use svbench::judge::Judge;
use svbench::methods::{Limit, Registry};
use svbench::stress::{Finding, find_cause};

/// Whether a method, with a parameter that the limit speaks of, is wrong at any value from which on the limit says
/// so.
fn is_shown(judge: &Judge, id: &str, limit: &Limit, cause: &str) -> bool {
    let variants: Vec<_> = match limit.with {
        [] => vec![id.to_owned()],
        with => with
            .iter()
            .map(|(name, value)| format!("{id},{name}={value}"))
            .collect(),
    };
    let cause = find_cause(cause).unwrap();
    let values = cause
        .values
        .iter()
        .copied()
        .filter(|&value| limit.covers(&cause.id, value));
    let values: Vec<_> = values.collect();
    variants.iter().any(|variant| {
        let methods = [Registry::builtin().parse(variant).unwrap()];
        values.iter().rev().any(|&value| {
            let trial = judge.trial(&cause.scene(value, 0), &methods);
            let drawn = trial.attempts[0].drawn();
            drawn.is_some_and(|drawn| {
                let finding = Finding::of(methods[0].as_ref(), Some((&cause.id, value)), drawn);
                matches!(finding, Finding::Declared(_))
            })
        })
    })
}

#[test]
fn every_declared_cause_fails() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    // Methods share limits: one of them has to show each.
    let mut shown: BTreeMap<(&str, &str), bool> = BTreeMap::new();
    for method in Registry::builtin().iter() {
        for limit in method.info.limits.iter().copied().flatten() {
            for (cause, _) in limit.fails {
                let shown = shown.entry((limit.text, *cause)).or_default();
                *shown = *shown || is_shown(&judge, method.info.id, limit, cause);
            }
        }
    }
    assert!(shown.len() > 10, "limits with causes: {}", shown.len());
    let idle: Vec<_> = shown
        .iter()
        .filter(|(_, shown)| !**shown)
        .map(|(what, _)| what)
        .collect();
    assert!(idle.is_empty(), "declared, and nothing is wrong: {idle:#?}");
}
