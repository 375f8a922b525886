//! What people read of a stress run: a matrix of causes and methods for the terminal and as Markdown, and
//! one self-contained HTML page with a picture of every first failure.
//!
//! It is made from the files of the run alone, see [`crate::record::stress`].

mod matrix;
mod text;

pub use crate::record::StressRun;
pub use matrix::{Cell, Counts, Failure, Line, Matrix, Unseen};

/// Name of the Markdown matrix in the directory of a stress run.
pub const MATRIX_FILE: &str = "matrix.md";

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;
