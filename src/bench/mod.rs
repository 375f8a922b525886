//! Running a plan: load each scene, find biases, prepare its methods, verify their masks, measure them
//! interleaved, and keep every result as it comes.
//!
//! The schedule decides what is done when, and what becomes of a cell that breaks; an [`executor::Executor`] does it,
//! on a device or, in tests, on none.

mod cell;
mod executor;
mod measure;
mod on_gpu;
mod prepare;
mod runner;
mod scene_run;
mod time_limit;
mod verify_cells;

#[cfg(test)]
mod schedule_tests;
#[cfg(test)]
mod stand_in;

pub use runner::{RunOutcome, RunRequest, run};

use crate::config::RunPlan;
use crate::judge::Observer;

/// What is to be run, and who watches.
#[derive(Clone, Copy)]
struct Watched<'a> {
    plan: &'a RunPlan,
    observer: &'a dyn Observer,
}
