//! A stress run, read back from its directory.

use super::check_files;
use super::read::{Head, read_head, read_lines};
use super::stress::{FORMAT, ROWS_FILE, STRESS_FILE, StressInfo, StressMethod, StressRow};
use anyhow::{Result, bail};
use std::path::{Path, PathBuf};

/// A stress run as its directory tells it.
#[derive(Debug, Clone)]
pub struct StressRun {
    /// The directory.
    pub dir: PathBuf,
    /// What was tried and where.
    pub info: StressInfo,
    /// Every picture.
    pub rows: Vec<StressRow>,
    /// What reading it had to work around.
    pub warnings: Vec<String>,
}

impl StressRun {
    /// Reads the directory `dir`. Of a run that was cut off, the table may be missing and its last row torn.
    ///
    /// # Errors
    /// When a file is missing or broken; the message names it and the line.
    pub fn read(dir: &Path) -> Result<Self> {
        let head = Head {
            file: STRESS_FILE,
            format: FORMAT,
            what: "the directory of a stress run",
            instead: "name a directory that one has written",
        };
        let info: StressInfo = read_head(dir, &head)?;
        let path = dir.join(ROWS_FILE);
        let mut warnings = Vec::from_iter(check_files(dir, STRESS_FILE, &info.files)?);
        let lines = read_lines(&path, STRESS_FILE, !info.complete, &mut warnings)?;
        let mut rows: Vec<StressRow> = Vec::with_capacity(lines.len());
        for (line, row) in lines {
            if let Some(fault) = fault(&info, &row) {
                bail!("{}, line {line}: {fault}", path.display());
            }
            rows.push(row);
        }
        Ok(Self {
            dir: dir.to_owned(),
            info,
            rows,
            warnings,
        })
    }
}

/// What is wrong with a row, if anything is.
fn fault(info: &StressInfo, row: &StressRow) -> Option<String> {
    let is_method = |m: &StressMethod| m.id == row.method && m.variant == row.variant;
    if !info.causes.iter().any(|cause| cause.id == row.cause) {
        Some(format!("{STRESS_FILE} has no cause `{}`", row.cause))
    } else if !info.methods.iter().any(is_method) {
        let name = format!("{} {}", row.method, row.variant);
        Some(format!("{STRESS_FILE} has no method `{}`", name.trim_end()))
    } else if row.picture.contains(['/', '\\', ':']) || row.picture.starts_with('.') {
        // The page holds the picture, so a row must not name any file of the machine.
        Some(format!("`{}` is not the name of a picture", row.picture))
    } else if row.value.is_nan() {
        Some("the value is not a number".to_owned())
    } else {
        None
    }
}
