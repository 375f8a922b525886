//! What people read of a run: a Markdown table, plots, and one self-contained HTML page.
//!
//! A report is made from the files of a run directory alone (see [`crate::bench::record`]), so it
//! can be made again at any time, by another version of the program, on another machine, and also
//! for a run that was interrupted.
//!
//! One output a file: [`table`], [`plots`], [`html`]. An output reads a [`Run`] and knows nothing
//! of the others, save that the page embeds the table's figures and the plots.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};

pub mod format;
pub mod html;
pub mod load;
pub mod plots;
pub mod table;

mod write;

pub use load::Run;

/// Name of the Markdown table in a run directory.
pub const TABLE_FILE: &str = "table.md";
/// Name of the folder of plots in a run directory.
pub const PLOTS_DIR: &str = "plots";
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
    write::text(&dir.join(TABLE_FILE), &table::markdown(&run))?;

    let plots = plots::draw(&run)?;
    let plots_dir = dir.join(PLOTS_DIR);
    std::fs::create_dir_all(&plots_dir)
        .with_context(|| format!("cannot create {}", plots_dir.display()))?;
    for plot in &plots {
        write::text(&plots_dir.join(format!("{}.svg", plot.name)), &plot.svg)?;
        write::replace(&plots_dir.join(format!("{}.png", plot.name)), |path| {
            plot.write_png(path)
        })?;
    }

    let page = dir.join(HTML_FILE);
    write::text(&page, &html::page(&run, &plots, legend)?)?;
    Ok(page)
}

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;
