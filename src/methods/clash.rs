//! Parameters of a method that do not go together.

use super::Parameter;
use serde::Serialize;

/// What becomes of parameters beside another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Effect {
    /// The method says that it cannot run.
    Refused,
    /// They change no picture.
    Ignored,
}

/// Parameters that do not go together with a value of another.
#[derive(Debug, Clone)]
pub struct Clash {
    /// The other one, name and value.
    pub beside: (&'static str, &'static str),
    /// Parameters at other values than their defaults: each a name, or `name=value` where only that value clashes.
    pub parameters: &'static [&'static str],
    /// What becomes of them.
    pub effect: Effect,
    /// Why, in words.
    pub why: &'static str,
}

impl Clash {
    /// Those of its parameters that a method with these has; none where it lacks the other one.
    pub fn of(&self, parameters: &[Parameter]) -> Vec<&'static str> {
        let has = |name: &str| parameters.iter().any(|own| own.name == name);
        let name_of = |parameter: &'static str| parameter.split('=').next().unwrap_or(parameter);
        let clashing = self.parameters.iter().copied();
        let clashing = clashing.filter(|parameter| has(name_of(parameter)));
        if has(self.beside.0) {
            clashing.collect()
        } else {
            Vec::new()
        }
    }
}

/// A plan decides what other parameters would.
pub(super) const PLAN: Clash = Clash {
    beside: ("plan", "auto"),
    parameters: &[
        "counting", "reach", "culling", "occluded", "casting", "edges",
    ],
    effect: Effect::Refused,
    why: "the plan decides them",
};

/// Z-fail has no second count.
pub(super) const Z_FAIL: Clash = Clash {
    beside: ("counting", "z_fail"),
    parameters: &["casting=each_side"],
    effect: Effect::Ignored,
    why: "a second count goes on where the first has ended, in front of what is visible: of objects that are not closed, all triangles cast",
};

/// Z-pass has no caps.
pub(super) const Z_PASS: Clash = Clash {
    beside: ("counting", "z_pass"),
    parameters: &["caps", "front_cap"],
    effect: Effect::Ignored,
    why: "z-pass draws no caps",
};

/// Those of volume methods. Whatever is not among them may be set together: each way to find silhouettes with each counter, way of
/// counting and plan.
pub(super) const OF_VOLUMES: &[Clash] = &[PLAN, Z_FAIL, Z_PASS];
