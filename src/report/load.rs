//! A run, read back from its directory.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use serde::de::DeserializeOwned;

use crate::bench::record::{
    Cell, FORMAT, RUN_FILE, RunInfo, RunStatus, SAMPLES_FILE, SUMMARY_FILE, Sample, Status, Summary,
};

/// A run as its directory tells it.
#[derive(Debug, Clone)]
pub struct Run {
    /// The run directory.
    pub dir: PathBuf,
    /// Where the numbers come from.
    pub info: RunInfo,
    /// Every measured frame.
    pub samples: Vec<Sample>,
    /// Every cell. Cells that were cut off before they were summed up come last.
    pub summaries: Vec<Summary>,
    /// The run's own warnings, then what reading it had to work around.
    pub warnings: Vec<String>,
}

/// A method with what tells its rows apart: what a line, a bar colour or a table row stands for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Contender {
    /// Id of the method.
    pub method: String,
    /// Variant, and the size where it is not the run's own; may be empty.
    pub variant: String,
}

impl Contender {
    /// Id and variant in one line.
    pub fn label(&self) -> String {
        format!("{} {}", self.method, self.variant)
            .trim_end()
            .to_owned()
    }
}

impl Run {
    /// Reads the run directory `dir`.
    ///
    /// A run that was cut off is read as far as it goes: missing tables are empty, a torn last row
    /// is left out, and cells that were measured but not summed up count as unverified.
    pub fn read(dir: &Path) -> Result<Self> {
        let info = read_info(dir)?;
        let mut warnings = info.warnings.clone();
        let cut_off = info.status != RunStatus::Complete;
        let samples: Vec<Sample> = read_rows(&dir.join(SAMPLES_FILE), cut_off, &mut warnings)?;
        let mut summaries: Vec<Summary> =
            read_rows(&dir.join(SUMMARY_FILE), cut_off, &mut warnings)?;
        summaries.extend(unsummed(&samples, &summaries));
        Ok(Self {
            dir: dir.to_owned(),
            info,
            samples,
            summaries,
            warnings,
        })
    }

    /// Names of the scenes: in the run's order, then any that only the rows know.
    pub fn scenes(&self) -> Vec<&str> {
        let listed = self.info.scenes.iter().map(|scene| scene.name.as_str());
        unique(listed.chain(self.summaries.iter().map(|row| row.scene.as_str())))
    }

    /// The scene's name for people; its plain name where the run has no other.
    pub fn scene_title<'a>(&'a self, name: &'a str) -> &'a str {
        let record = self.info.scenes.iter().find(|scene| scene.name == name);
        record
            .map(|scene| scene.title.as_str())
            .filter(|title| !title.is_empty())
            .unwrap_or(name)
    }

    /// The method's name for people; its id where the run has no other.
    pub fn method_title<'a>(&'a self, contender: &'a Contender) -> &'a str {
        let record = self
            .info
            .methods
            .iter()
            .find(|method| method.id == contender.method);
        let title = record
            .map(|method| method.title.as_str())
            .filter(|title| !title.is_empty());
        title.unwrap_or(&contender.method)
    }

    /// Whom the run compares: in the run's order, then any that only the rows know.
    ///
    /// A contender's place in this list decides its colour and marker in every plot.
    pub fn contenders(&self) -> Vec<Contender> {
        let listed = self.info.methods.iter().map(|method| Contender {
            method: method.id.clone(),
            variant: method.variant.clone(),
        });
        unique(listed.chain(self.summaries.iter().map(|row| self.contender(row))))
    }

    /// Whom a row is about.
    pub fn contender(&self, row: &Summary) -> Contender {
        let Summary {
            method,
            variant,
            width,
            height,
            ..
        } = row;
        let own_size = (self.info.width, self.info.height) == (*width, *height);
        let size = if own_size {
            String::new()
        } else {
            format!(" {width}×{height}")
        };
        Contender {
            method: method.clone(),
            variant: format!("{variant}{size}").trim().to_owned(),
        }
    }

    /// The rows of a scene, in the order of [`Self::contenders`].
    pub fn rows(&self, scene: &str) -> Vec<&Summary> {
        let contenders = self.contenders();
        let mut rows: Vec<&Summary> = self.summaries.iter().filter(|r| r.scene == scene).collect();
        rows.sort_by_key(|row| {
            let contender = self.contender(row);
            contenders.iter().position(|other| *other == contender)
        });
        rows
    }

    /// The samples that a row sums up.
    pub fn samples_of<'a>(&'a self, row: &'a Summary) -> impl Iterator<Item = &'a Sample> {
        self.samples.iter().filter(|sample| is_of(sample, row))
    }

    /// The shortest median shadow time among a scene's rows of this row's size that have no
    /// artifacts: being fast and wrong is no merit.
    pub fn best_shadow_ms(&self, row: &Summary) -> Option<f64> {
        self.summaries
            .iter()
            .filter(|other| other.scene == row.scene && other.status == Status::Ok)
            .filter(|other| (other.width, other.height) == (row.width, row.height))
            .filter(|other| other.artifact_px == Some(0))
            .filter_map(|other| other.shadow_ms_median)
            .min_by(f64::total_cmp)
    }

    /// Whether this row is right and has the scene's best shadow time.
    pub fn is_best(&self, row: &Summary) -> bool {
        row.status == Status::Ok
            && row.artifact_px == Some(0)
            && row.shadow_ms_median.is_some()
            && row.shadow_ms_median == self.best_shadow_ms(row)
    }
}

fn unique<T: PartialEq>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut seen = Vec::new();
    for item in items {
        if !seen.contains(&item) {
            seen.push(item);
        }
    }
    seen
}

fn is_of(sample: &Sample, row: &Summary) -> bool {
    sample.scene == row.scene
        && sample.method == row.method
        && sample.variant == row.variant
        && (sample.width, sample.height) == (row.width, row.height)
}

/// Rows for the cells that have samples but were cut off before they were summed up.
fn unsummed(samples: &[Sample], summaries: &[Summary]) -> Vec<Summary> {
    let mut rows: Vec<Summary> = Vec::new();
    for sample in samples {
        if summaries.iter().chain(&rows).any(|row| is_of(sample, row)) {
            continue;
        }
        let cell = Cell {
            scene: sample.scene.clone(),
            triangles: Some(sample.triangles),
            objects: Some(sample.objects),
            method: sample.method.clone(),
            variant: sample.variant.clone(),
            width: sample.width,
            height: sample.height,
            ..Cell::default()
        };
        let blank = Summary::from_samples(&cell, &[], &[], Status::Unverified, "");
        let own: Vec<Sample> = samples
            .iter()
            .filter(|s| is_of(s, &blank))
            .cloned()
            .collect();
        let reason = "the run was cut off in this cell";
        rows.push(Summary::from_samples(
            &cell,
            &own,
            &[],
            Status::Unverified,
            reason,
        ));
    }
    rows
}

fn read_info(dir: &Path) -> Result<RunInfo> {
    let path = dir.join(RUN_FILE);
    let text = match fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => bail!(
            "{} is not a run directory: it has no {RUN_FILE}; name a directory that `svbench run` \
             has written",
            dir.display()
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
    if format > u64::from(FORMAT) {
        bail!(
            "{} has format {format}, and this version of svbench reads up to {FORMAT}: use the \
             version that wrote it, or a newer one",
            path.display()
        );
    }
    serde_json::from_value(value).with_context(|| format!("{} is damaged", path.display()))
}

/// Reads a table. With `cut_off`, it may be missing, and its last row may be torn.
fn read_rows<T: DeserializeOwned>(
    path: &Path,
    cut_off: bool,
    warnings: &mut Vec<String>,
) -> Result<Vec<T>> {
    let mut text = match fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound && cut_off => return Ok(Vec::new()),
        Err(error) if error.kind() == ErrorKind::NotFound => bail!(
            "{} is missing although {RUN_FILE} says that the run is complete: restore the file or \
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
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader
        .deserialize()
        .collect::<Result<_, csv::Error>>()
        .map_err(|error| {
            let line = error.position().map_or(1, csv::Position::line);
            anyhow::anyhow!("{}, line {line}: {}", path.display(), what_is_wrong(&error))
        })
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
