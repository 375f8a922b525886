//! Running a plan: load each scene, prepare its methods, verify their masks, measure them
//! interleaved, and keep every result as it comes.

mod bias_search;
mod cell;
mod fault;
mod measure;
mod observer;
mod preparation;
pub mod provenance;
pub mod record;
mod run_dir;
mod runner;
mod scene_run;
pub mod statistics;
pub mod verify;
mod verify_cells;

pub(crate) use fault::in_one_line;
pub use observer::Observer;
pub use run_dir::new_directory;
pub use runner::{RunRequest, run};
pub use verify::Verifier;
