//! Whom a run compares, and which of them are points of one curve.

use super::load::{Run, unique};
use crate::record::SweepRecord;

/// A method with what tells its rows apart: what a line, a bar colour or a table row stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contender {
    /// Id of the method.
    pub method: String,
    /// Variant, and the size where it is not the run's own; may be empty.
    pub variant: String,
}

impl Contender {
    /// A method in a variant, which may be empty.
    pub fn new(method: impl Into<String>, variant: impl Into<String>) -> Self {
        Self {
            method: method.into(),
            variant: variant.into(),
        }
    }

    /// Id and variant in one line.
    pub fn label(&self) -> String {
        format!("{} {}", self.method, self.variant)
            .trim_end()
            .to_owned()
    }
}

/// What shares a colour in the plots: the contenders that a sweep of one parameter made, or one
/// contender alone.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Curve {
    /// Its name: method and variant without the swept parameter.
    pub name: Contender,
    /// The swept parameter; `None` for a contender alone.
    pub parameter: Option<String>,
}

impl Curve {
    /// The curve that `contender` is a point of.
    pub fn of(contender: &Contender, sweep: Option<&SweepRecord>) -> Self {
        Self {
            name: sweep.map_or_else(
                || contender.clone(),
                |sweep| Contender::new(&contender.method, sweep.curve.to_string()),
            ),
            parameter: sweep.map(|sweep| sweep.parameter.clone()),
        }
    }

    /// Its name as a legend says it: a swept one with `by` and its parameter.
    pub fn legend(&self) -> Contender {
        let by = self.parameter.as_ref().map(|name| format!("by {name}"));
        let variant = [self.name.variant.clone(), by.unwrap_or_default()].join(" ");
        Contender::new(&self.name.method, variant.trim())
    }
}

/// The curves of a run, and which contender is on which.
#[derive(Debug)]
pub struct Curves {
    /// The curves, in the order of [`Run::contenders`].
    pub all: Vec<Curve>,
    /// Every contender, the place of its curve in `all`, and its value on a swept one.
    pub members: Vec<(Contender, usize, Option<f64>)>,
}

impl Curves {
    /// The curves of a run. Rows of a size that is not the run's own are curves of their own.
    pub fn of(run: &Run) -> Self {
        let contenders = run.contenders();
        let curve = |contender: &Contender| Curve::of(contender, run.sweep_of(contender));
        let all = unique(contenders.iter().map(curve));
        let members = contenders.into_iter().map(|contender| {
            let own = curve(&contender);
            let place = all.iter().position(|curve| *curve == own);
            let value = run.sweep_of(&contender).map(|sweep| sweep.value);
            (contender, place.unwrap_or_default(), value)
        });
        let members = members.collect();
        Self { all, members }
    }

    /// The place of a contender's curve.
    pub fn place(&self, contender: &Contender) -> usize {
        let member = self.members.iter().find(|(known, ..)| known == contender);
        member.map_or(0, |(_, place, _)| *place)
    }
}
