//! svbench: a benchmark of hard-shadow algorithms.
//!
//! In reading order, from the user down to the device:

pub mod cli;
pub mod config;

pub mod advise;
pub mod profile;
pub mod report;
pub mod stress;

pub mod bench;
pub mod judge;
pub mod record;

pub mod frame;
pub mod methods;
pub mod metrics;
pub mod reference;

pub mod geometry;
pub mod scene;

pub mod console;
pub mod file_name;
pub mod gpu;
pub mod memory;
pub mod output;
mod panics;
pub mod table;
pub mod toml_array;
pub mod toml_error;
pub mod variant;

/// What methods of other crates are written with, in the versions that this one takes.
pub use {bytemuck, glam, wgpu};
