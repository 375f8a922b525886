//! Running a plan: load each scene, find biases, prepare its methods, verify their masks, measure them
//! interleaved, and keep every result as it comes.
//!
//! The schedule decides what is done when, and what becomes of a cell that breaks. An executor does the
//! work: `on_gpu` on a device, `stand_in` without one. So faults that no driver produces on demand are tests of some
//! milliseconds: for example, `schedule_tests` loses the device at a chosen frame, and checks that this cell alone has
//! failed and that the others have all of their frames.

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
