//! The files of a run directory, read with errors that say where to look.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use anyhow::{Context as _, Result, bail};
use serde::de::DeserializeOwned;

use crate::record::{FORMAT, RUN_FILE, RunInfo};
use crate::table::unguarded;

/// The file by which a directory is known for what it is.
pub(crate) struct Head {
    /// Its name.
    pub file: &'static str,
    /// Newest layout that this version reads.
    pub format: u32,
    /// What a directory without it is not.
    pub what: &'static str,
    /// Which directory to name instead.
    pub instead: &'static str,
}

/// Reads `run.json`.
pub(crate) fn read_info(dir: &Path) -> Result<RunInfo> {
    let head = Head {
        file: RUN_FILE,
        format: FORMAT,
        what: "a run directory",
        instead: "name a directory that `svbench run` has written",
    };
    read_head(dir, &head)
}

/// Reads the file that says what a directory holds.
pub(crate) fn read_head<T: DeserializeOwned>(dir: &Path, head: &Head) -> Result<T> {
    let path = dir.join(head.file);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => bail!(
            "{} is not {}: it has no {}; {}",
            dir.display(),
            head.what,
            head.file,
            head.instead
        ),
        Err(error) => {
            return Err(error).with_context(|| format!("cannot read {}", path.display()));
        }
    };
    // The version comes first: a newer layout would otherwise be reported as a missing field.
    let value: serde_json::Value =
        serde_json::from_str(&text).with_context(|| format!("{} is damaged", path.display()))?;
    let format = value
        .get("format")
        .and_then(serde_json::Value::as_u64)
        .unwrap_or_default();
    if format > u64::from(head.format) {
        bail!(
            "{} has format {format}, and this version of svbench reads up to {}: use the \
             version that wrote it, or a newer one",
            path.display(),
            head.format
        );
    }
    serde_json::from_value(value).with_context(|| format!("{} is damaged", path.display()))
}

/// Reads a table that a run need not have.
pub(crate) fn read_optional_rows<T: DeserializeOwned>(
    path: &Path,
    cut_off: bool,
    warnings: &mut Vec<String>,
) -> Result<Vec<T>> {
    if path.exists() {
        read_rows(path, cut_off, warnings)
    } else {
        Ok(Vec::new())
    }
}

/// Reads a table. With `cut_off`, it may be missing, and its last row may be torn.
pub(crate) fn read_rows<T: DeserializeOwned>(
    path: &Path,
    cut_off: bool,
    warnings: &mut Vec<String>,
) -> Result<Vec<T>> {
    let lines = read_lines(path, RUN_FILE, cut_off, warnings)?;
    Ok(lines.into_iter().map(|(_, row)| row).collect())
}

/// As [`read_rows`], each row with the line where it begins; `head` is the file that says whether the
/// run is complete.
pub(crate) fn read_lines<T: DeserializeOwned>(
    path: &Path,
    head: &str,
    cut_off: bool,
    warnings: &mut Vec<String>,
) -> Result<Vec<(u64, T)>> {
    let mut text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound && cut_off => return Ok(Vec::new()),
        Err(error) if error.kind() == ErrorKind::NotFound => bail!(
            "{} is missing although {head} says that the run is complete: restore the file or \
             repeat the run",
            path.display()
        ),
        Err(error) => {
            return Err(error).with_context(|| format!("cannot read {}", path.display()));
        }
    };
    if cut_off && !text.is_empty() && !text.ends_with('\n') {
        text.truncate(text.rfind('\n').map_or(0, |end| end + 1));
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        warnings.push(format!("the last row of {name} is torn and was left out"));
    }
    parse(&text).map_err(|error| {
        let line = error.position().map_or(1, csv::Position::line);
        anyhow::anyhow!("{}, line {line}: {}", path.display(), what_is_wrong(&error))
    })
}

fn parse<T: DeserializeOwned>(text: &str) -> Result<Vec<(u64, T)>, csv::Error> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers()?.clone();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record?;
        let line = record.position().map_or(1, csv::Position::line);
        rows.push((line, unguarded(&record).deserialize(Some(&headers))?));
    }
    Ok(rows)
}

/// The core of a CSV error, without the position that the caller has already named.
fn what_is_wrong(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::Deserialize { err, .. } => err.to_string(),
        csv::ErrorKind::UnequalLengths {
            expected_len, len, ..
        } => {
            format!("{len} fields where the header has {expected_len}")
        }
        _ => error.to_string(),
    }
}
