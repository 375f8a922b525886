//! What people read of a run: a Markdown table, plots, and one self-contained HTML page.
//!
//! A report is made from the files of a run directory alone (see [`crate::record`]), so it
//! can be made again at any time, by another version of the program, on another machine, and also
//! for a run that was interrupted.
//!
//! One output a file: [`table`], [`pareto`], [`plots`], [`paper`], [`html`]. An output reads a [`Run`] and knows
//! nothing of the others, save that the page embeds the table's figures, the paper and the plots.
//! [`merged`] puts several runs beside the paper; [`stability`] is about runs of another kind.

use std::path::{Path, PathBuf};
use std::slice;

use anyhow::{Context as _, Result};

use crate::output::{self, remove_stale, write_atomically};
use paper::Paper;
use plots::Plot;

pub mod curve;
pub mod format;
pub mod groups;
pub mod html;
pub mod load;
pub mod merged;
pub mod paper;
pub mod pareto;
pub mod plots;
pub mod stability;
pub mod table;

mod markdown;

pub use load::Run;
pub use merged::write_merged;
pub use stability::write_stability;

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
    write_atomically(&dir.join(TABLE_FILE), table::markdown(&run))?;

    let groups = groups::group(slice::from_ref(&run), false)?;
    let paper = Paper::compare(&groups)?;
    paper::write(dir, paper.as_ref())?;
    let clouds = pareto::clouds(&run);
    pareto::write(dir, &clouds)?;
    let mut plots = plots::draw_pareto(&run, &clouds)?;
    plots.extend(paper.as_ref().map_or(Ok(Vec::new()), plots::draw_paper)?);
    plots.extend(plots::draw(&run)?);
    write_plots(dir, &plots)?;

    let page = dir.join(HTML_FILE);
    let text = html::page(&run, paper.as_ref(), &clouds, &plots, legend)?;
    write_atomically(&page, &text)?;
    Ok(page)
}

/// Writes the plots into the folder `plots` of `dir`, and removes figures of the paper and of accuracy
/// that an earlier report wrote and this one does not.
fn write_plots(dir: &Path, plots: &[Plot]) -> Result<()> {
    let dir = dir.join(PLOTS_DIR);
    output::create_dir_all(&dir)?;
    for plot in plots {
        write_atomically(&dir.join(format!("{}.svg", plot.name)), &plot.svg)?;
        plot.write_png(&dir.join(format!("{}.png", plot.name)))?;
    }
    let stale = paper::figure_names().chain(accuracy_plots(&dir)?);
    for name in stale.filter(|name| plots.iter().all(|plot| plot.name != *name)) {
        remove_stale(&dir.join(format!("{name}.svg")))?;
        remove_stale(&dir.join(format!("{name}.png")))?;
    }
    Ok(())
}

/// The names of the plots of accuracy in the folder `dir`: they depend on its scenes, so
/// that only the folder knows what an earlier report wrote.
fn accuracy_plots(dir: &Path) -> Result<Vec<String>> {
    let unreadable = || format!("cannot read {}", dir.display());
    let mut names = Vec::new();
    for entry in dir.read_dir().with_context(unreadable)? {
        let path = entry.with_context(unreadable)?.path();
        let is_plot = matches!(
            path.extension().and_then(|e| e.to_str()),
            Some("svg" | "png")
        );
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        if is_plot
            && plots::SCENE_PLOT_PREFIXES
                .iter()
                .any(|prefix| name.starts_with(prefix))
        {
            names.push(name.into_owned());
        }
    }
    Ok(names)
}

#[cfg(test)]
mod fixture;
#[cfg(test)]
mod tests;
