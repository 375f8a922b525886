//! What people read of a stress run: a matrix of causes and methods for the terminal and as Markdown, and
//! one self-contained HTML page with a picture of every first failure.
//!
//! It is made from the files of the run alone, see [`crate::record::stress`].

use super::{HTML_FILE, LegendEntry, html};
use crate::output::write_atomically;
use anyhow::Result;
use std::path::{Path, PathBuf};

mod matrix;
mod text;

pub use crate::record::StressRun;
pub use matrix::{Cell, Counts, Failure, Line, Matrix, Unseen};

/// Name of the Markdown matrix in the directory of a stress run.
pub const MATRIX_FILE: &str = "matrix.md";

/// Reads the stress run in `dir` and writes the matrix and the page into it; gives the path of the page.
/// `legend` explains the colours of the error maps.
///
/// # Errors
/// When a file of the run is broken, or one cannot be written.
pub fn write_stability(dir: &Path, legend: &[LegendEntry]) -> Result<PathBuf> {
    let run = StressRun::read(dir)?;
    write_atomically(&dir.join(MATRIX_FILE), run.matrix_markdown())?;
    let page = dir.join(HTML_FILE);
    write_atomically(&page, &html::stability_page(&run, legend)?)?;
    Ok(page)
}

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;
