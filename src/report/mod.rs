//! What people read of a run: a Markdown table, plots, and one self-contained HTML page.
//!
//! A report is made from the files of a run directory alone (see [`crate::record`]), so it
//! can be made again at any time, by another version of the program, on another machine, and also
//! for a run that was interrupted.
//!
//! One output a file: `results`, `pareto`, `plots`, `paper`, `html`. An output reads a [`Run`] and knows
//! nothing of the others, save that the page embeds the results, the papers and the plots. All tables are
//! `table`s.
//! `merged` puts several runs beside the paper; [`stability`] is about runs of another kind.

use std::path::{Path, PathBuf};
use std::slice;

use anyhow::Result;

use crate::output::write_atomically;

mod curve;
mod format;
mod groups;
pub(crate) mod html;
mod load;
mod merged;
mod paper;
mod pareto;
pub(crate) mod plots;
mod results;
pub mod stability;
mod table;

use load::Run;
pub use merged::write_merged;

/// Name of the Markdown table in a run directory.
pub const TABLE_FILE: &str = "table.md";
/// Name of the HTML page in a run directory.
pub const HTML_FILE: &str = "report.html";

/// What one colour of the error maps means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LegendEntry {
    /// What a pixel of this colour is.
    pub label: &'static str,
    /// The colour, sRGB.
    pub rgb: [u8; 3],
}

/// Reads the run directory `dir` and writes every output into it; gives the path of the HTML page.
///
/// Each file is written beside its name and then renamed, so that a report that could not be
/// finished never passes for one. `legend` explains the colours of the run's error maps.
pub fn write_all(dir: &Path, legend: &[LegendEntry]) -> Result<PathBuf> {
    let run = Run::read(dir)?;
    write_atomically(&dir.join(TABLE_FILE), results::markdown(&run))?;

    let groups = groups::group(slice::from_ref(&run), false)?;
    let papers = paper::compare(&groups)?;
    paper::write(dir, &papers)?;
    let clouds = pareto::clouds(&run);
    pareto::write(dir, &clouds)?;
    let mut plots = plots::draw_pareto(&run, &clouds)?;
    plots.extend(plots::draw_papers(&papers)?);
    plots.extend(plots::draw(&run)?);
    plots::write(dir, &plots)?;

    let page = dir.join(HTML_FILE);
    let text = html::page(&run, &papers, &clouds, &plots, legend)?;
    write_atomically(&page, &text)?;
    Ok(page)
}

/// Reads the stress run in `dir` and writes the matrix and the page into it; gives the path of the page.
/// `legend` explains the colours of the error maps.
///
/// # Errors
/// When a file of the run is broken, or one cannot be written.
pub fn write_stability(dir: &Path, legend: &[LegendEntry]) -> Result<PathBuf> {
    let run = stability::StressRun::read(dir)?;
    write_atomically(&dir.join(stability::MATRIX_FILE), run.matrix_markdown())?;
    let page = dir.join(HTML_FILE);
    write_atomically(&page, &html::stability_page(&run, legend)?)?;
    Ok(page)
}

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;
