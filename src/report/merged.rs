//! Several runs beside the paper: one report in a folder of its own.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use serde::Serialize;

use super::groups::{self, Group};
use super::load::Run;
use super::{HTML_FILE, html, paper, plots};
use crate::output::{self, write_atomically};
use crate::record::RunStatus;

/// Name of the file that says which runs a merged report was made of, and by which such a report is
/// known.
pub const MERGED_FILE: &str = "merged.json";
/// Version of [`MERGED_FILE`]'s layout.
const FORMAT: u32 = 1;

/// What [`MERGED_FILE`] holds.
#[derive(Debug, Serialize)]
struct Merged<'a> {
    format: u32,
    runs: Vec<MergedRun<'a>>,
}

#[derive(Debug, Serialize)]
struct MergedRun<'a> {
    dir: Cow<'a, str>,
    /// Label of its group of columns.
    group: &'a str,
    device: &'a str,
    driver_info: &'a str,
    program_version: &'a str,
    started: &'a str,
    status: RunStatus,
}

/// Reads the run directories `dirs` and writes one report of them into `out`; gives the path of the
/// HTML page. `out` must be new, empty, or a merged report.
///
/// # Errors
/// Where a directory is no run or is given twice, and where runs differ in settings in which they
/// must agree, unless `force` is set.
pub fn write_merged(dirs: &[PathBuf], out: &Path, force: bool) -> Result<PathBuf> {
    groups::check_distinct(dirs.iter().map(PathBuf::as_path))?;
    let runs: Vec<Run> = dirs
        .iter()
        .map(|dir| Run::read(dir))
        .collect::<Result<_>>()?;
    let groups = groups::group(&runs, force)?;
    let papers = paper::compare(&groups)?;
    let plots = plots::draw_papers(&papers)?;

    prepare(out)?;
    // First, so that a report that could not be finished can be written again.
    write_atomically(&out.join(MERGED_FILE), &contents(&groups)?)?;
    paper::write(out, &papers)?;
    plots::write(out, &plots)?;
    let page = out.join(HTML_FILE);
    write_atomically(&page, html::merged_page(&groups, &papers, &plots))?;
    Ok(page)
}

/// Creates the folder; what is not a merged report is left alone.
fn prepare(out: &Path) -> Result<()> {
    if out.exists() && !out.is_dir() {
        bail!(
            "{} is not a directory: choose another with --out",
            out.display()
        );
    }
    let unreadable = || format!("cannot read {}", out.display());
    let filled = out.is_dir() && out.read_dir().with_context(unreadable)?.next().is_some();
    if filled && !out.join(MERGED_FILE).is_file() {
        bail!(
            "{} is not empty and holds no merged report: choose another directory with --out",
            out.display()
        );
    }
    output::create_dir_all(out)
}

fn contents(groups: &[Group<'_>]) -> Result<String> {
    let runs = groups.iter().flat_map(|group| {
        group.runs.iter().map(|run| MergedRun {
            dir: run.dir.to_string_lossy(),
            group: &group.label,
            device: &run.info.device.name,
            driver_info: &run.info.device.driver_info,
            program_version: &run.info.program_version,
            started: &run.info.started,
            status: run.info.status,
        })
    });
    let merged = Merged {
        format: FORMAT,
        runs: runs.collect(),
    };
    Ok(serde_json::to_string_pretty(&merged)? + "\n")
}
