//! Running a plan: load each scene, prepare its methods, verify their masks, measure them
//! interleaved, and keep every result as it comes.

mod bias_search;
mod cell;
mod fault;
mod measure;
mod preparation;
mod runner;
mod scene_run;
mod verify_cells;

pub use runner::{RunRequest, run};
