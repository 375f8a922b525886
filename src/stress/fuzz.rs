//! Differential fuzzing: random scenes, every method against the truth.

use super::finding::Finding;
use super::random;
use crate::judge::Observer;
use crate::judge::{Attempt, Judge, NoPicture, Trial};
use crate::methods::ShadowMethod;
use crate::metrics::MaskError;
use crate::scene::Scene;
use std::ops::Range;
use std::time::{Duration, Instant};

/// What to try.
#[derive(Debug, Clone)]
pub struct FuzzPlan {
    /// Seeds of the random scenes, see [`random::case`].
    pub seeds: Range<u64>,
    /// Stop after this time.
    pub budget: Option<Duration>,
}

/// A picture that a method got wrong.
pub struct Failure<'a> {
    /// The seed of the scene.
    pub seed: u64,
    /// The scene.
    pub scene: &'a Scene,
    /// Index of the method.
    pub method: usize,
    /// Whether the method declares it.
    pub finding: Finding,
    /// The picture, with those of the other methods.
    pub trial: &'a Trial,
}

/// What all cases of one method came to.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    /// Cases drawn.
    pub cases: u64,
    /// Cases with errors that the method declares.
    pub declared: u64,
    /// Cases with errors that it does not.
    pub undeclared: u64,
    /// Sum over all pictures.
    pub error: MaskError,
    /// Why it could not draw the last of the others, if there are any.
    pub unavailable: Option<String>,
    /// Cases of which there is no picture because something broke.
    pub failed: u64,
    /// What broke in the last of them.
    pub failure: Option<String>,
}

/// Draws random scenes until there are no more seeds, the time is up or the user interrupts; `found` is told
/// of every failure. Gives a tally a method.
///
/// # Errors
/// When `found` fails.
pub fn fuzz(
    judge: &Judge,
    methods: &[Box<dyn ShadowMethod>],
    plan: &FuzzPlan,
    observer: &dyn Observer,
    mut found: impl FnMut(&Failure<'_>) -> anyhow::Result<()>,
) -> anyhow::Result<Vec<Tally>> {
    let started = Instant::now();
    let mut tallies = vec![Tally::default(); methods.len()];
    // Nobody knows how many scenes fit into a time.
    if plan.seeds.end < u64::MAX {
        observer.begin(plan.seeds.end - plan.seeds.start);
    }
    for seed in plan.seeds.clone() {
        let is_late = plan.budget.is_some_and(|budget| started.elapsed() > budget);
        if is_late || observer.interrupted() {
            break;
        }
        let scene = random::case(seed);
        let trial = judge.trial(&scene, methods);
        for (index, (method, attempt)) in methods.iter().zip(&trial.attempts).enumerate() {
            let tally = &mut tallies[index];
            let drawn = match attempt {
                Attempt::Drawn(drawn) => drawn,
                Attempt::Missing(NoPicture::Unavailable(reason)) => {
                    tally.unavailable = Some(reason.clone());
                    continue;
                }
                Attempt::Missing(NoPicture::Failed(reason)) => {
                    tally.failed += 1;
                    tally.failure = Some(format!("seed {seed}: {reason}"));
                    continue;
                }
            };
            let finding = Finding::of(method.as_ref(), None, drawn);
            tally.cases += 1;
            tally.error += drawn.judgement.error;
            match finding {
                Finding::Right => continue,
                Finding::Declared(_) => tally.declared += 1,
                Finding::Undeclared => tally.undeclared += 1,
            }
            found(&Failure {
                seed,
                scene: &scene,
                method: index,
                finding,
                trial: &trial,
            })?;
        }
        observer.advance(1);
    }
    Ok(tallies)
}
