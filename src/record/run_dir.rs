//! Writing a run directory.
//!
//! `samples.csv`, `stages.csv`, `volumes.csv`, `metrics.csv`, `regions.csv` and `bias.csv` grow row by row, each flushed as it comes, so
//! that a run that dies keeps what it has. Everything else is written to a temporary file and renamed: a file that is there is whole.

use super::volume_rows::volume_row;
use super::{
    BIAS_FILE, BiasRow, COUNTERS_FILE, FileRecord, IMAGES_DIR, ImageKind, METRICS_FILE,
    REGIONS_FILE, RUN_FILE, RegionRow, RunDirError, RunInfo, RunStatus, SAMPLES_FILE, STAGES_FILE,
    SUMMARY_FILE, Sample, Summary, VOLUMES_FILE, VerifiedFrame, counter_rows, file_records,
    image_name, metric_rows, stage_rows, summary_records,
};
use crate::output;
use crate::table::{self, Table};
use crate::variant::Variant;
use anyhow::{Context, bail};
use serde::Serialize;
use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A table that is made with its first rows.
struct LateTable {
    path: PathBuf,
    table: Option<Table>,
}

impl LateTable {
    fn new(dir: &Path, name: &str) -> Self {
        Self {
            path: dir.join(name),
            table: None,
        }
    }

    fn append<T: Serialize>(&mut self, rows: &[T]) -> anyhow::Result<()> {
        if rows.is_empty() {
            return Ok(());
        }
        let table = match self.table.take() {
            Some(table) => table,
            None => Table::create(&self.path)?,
        };
        self.table.insert(table).append(rows)
    }
}

/// Creates a directory for results; if there is one, it must not hold anything yet.
///
/// # Errors
/// When it does, or cannot be created.
pub fn new_directory(path: &Path) -> anyhow::Result<()> {
    if path.is_dir() && path.read_dir()?.next().is_some() {
        bail!(
            "{} is not empty: choose another directory with --out",
            path.display()
        );
    }
    output::create_dir_all(path)
}

/// An open run directory.
pub(crate) struct RunDir {
    path: PathBuf,
    samples: Table,
    stages: LateTable,
    volumes: LateTable,
    metrics: LateTable,
    regions: LateTable,
    biases: LateTable,
    /// What `run.json` holds.
    info: Vec<u8>,
}

impl RunDir {
    /// Creates the directory; it must not hold anything yet.
    pub(crate) fn create(path: &Path) -> anyhow::Result<Self> {
        new_directory(path)?;
        let images = path.join(IMAGES_DIR);
        std::fs::create_dir(&images)
            .with_context(|| format!("cannot create {}", images.display()))?;
        Ok(Self {
            path: path.to_owned(),
            samples: Table::create(&path.join(SAMPLES_FILE))?,
            stages: LateTable::new(path, STAGES_FILE),
            volumes: LateTable::new(path, VOLUMES_FILE),
            metrics: LateTable::new(path, METRICS_FILE),
            regions: LateTable::new(path, REGIONS_FILE),
            biases: LateTable::new(path, BIAS_FILE),
            info: Vec::new(),
        })
    }

    /// Writes `run.json`, over the one before.
    pub(crate) fn write_info(&mut self, info: &RunInfo) -> Result<(), RunDirError> {
        let path = self.path.join(RUN_FILE);
        let write = || {
            let text = serde_json::to_vec_pretty(info)?;
            output::write_atomically(&path, &text)?;
            Ok(text)
        };
        self.info = RunDirError::of(write())?;
        Ok(())
    }

    /// Makes `run.json` say that the run failed, if it does not yet: where there is no room for another file, in the
    /// one that there is.
    pub(crate) fn mark_failed(&mut self) {
        let Ok(text) = std::str::from_utf8(&self.info) else {
            return;
        };
        let running = format!("\"status\": \"{}\"", RunStatus::Running.word());
        let failed = format!("\"status\": \"{}\"", RunStatus::Failed.word());
        // As long as before, so that no byte of it needs a new place on the disk.
        let text = text.replacen(&running, &format!("{failed:0$}", running.len()), 1);
        let path = self.path.join(RUN_FILE);
        let patched = OpenOptions::new()
            .write(true)
            .open(&path)
            .and_then(|mut file| file.write_all(text.as_bytes()));
        if let Err(error) = patched {
            log::warn!(
                "{} still says that the run is under way: {error}",
                path.display()
            );
        }
    }

    /// The tables and pictures that there are.
    pub(crate) fn file_records(&self) -> Result<Vec<FileRecord>, RunDirError> {
        const TABLES: [&str; 8] = [
            SAMPLES_FILE,
            STAGES_FILE,
            VOLUMES_FILE,
            SUMMARY_FILE,
            COUNTERS_FILE,
            METRICS_FILE,
            REGIONS_FILE,
            BIAS_FILE,
        ];
        RunDirError::of(file_records(&self.path, &TABLES, IMAGES_DIR))
    }

    /// Appends a row to `samples.csv`, its stages to `stages.csv`, and its volumes to `volumes.csv`.
    pub(crate) fn append_sample(&mut self, sample: &Sample) -> Result<(), RunDirError> {
        RunDirError::of(self.samples.append(std::slice::from_ref(sample)))?;
        RunDirError::of(self.stages.append(&stage_rows([sample])))?;
        RunDirError::of(self.volumes.append(volume_row(sample).as_slice()))
    }

    /// Appends a verified frame to `metrics.csv`, and its largest regions to `regions.csv`.
    pub(crate) fn append_verified(
        &mut self,
        frame: &VerifiedFrame,
        regions: &[RegionRow],
    ) -> Result<(), RunDirError> {
        RunDirError::of(self.metrics.append(&metric_rows([frame])))?;
        RunDirError::of(self.regions.append(regions))
    }

    /// Appends a row to `bias.csv`.
    pub(crate) fn append_bias(&mut self, bias: &BiasRow) -> Result<(), RunDirError> {
        RunDirError::of(self.biases.append(std::slice::from_ref(bias)))
    }

    /// Writes `summary.csv` and `counters.csv`, over the ones before.
    pub(crate) fn write_summary(&self, rows: &[Summary]) -> Result<(), RunDirError> {
        let write = || {
            let summary = table::text_of_records(&summary_records(rows)?)?;
            output::write_atomically(&self.path.join(SUMMARY_FILE), summary)?;
            let counters = counter_rows(rows);
            if counters.is_empty() {
                return Ok(());
            }
            output::write_atomically(&self.path.join(COUNTERS_FILE), table::text(&counters)?)
        };
        RunDirError::of(write())
    }

    /// Writes a picture of a cell.
    pub(crate) fn write_image(
        &self,
        (scene, method, variant): (&str, &str, &Variant),
        kind: ImageKind,
        image: &super::Image<'_>,
    ) -> Result<(), RunDirError> {
        let name = image_name(scene, method, variant, kind);
        RunDirError::of(image.write_png(&self.path.join(IMAGES_DIR).join(name)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_can_be_marked_as_failed_without_a_byte_more() {
        let room = tempfile::tempdir().unwrap();
        let mut dir = RunDir::create(&room.path().join("run")).unwrap();
        let mut info = RunInfo {
            // Words of the configuration are left alone.
            config_text: "\"status\": \"running\"".to_owned(),
            ..RunInfo::default()
        };
        dir.write_info(&info).unwrap();
        let path = room.path().join("run").join(RUN_FILE);
        let before = std::fs::metadata(&path).unwrap().len();
        dir.mark_failed();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text.len() as u64, before);
        let read: RunInfo = serde_json::from_str(&text).unwrap();
        info.status = RunStatus::Failed;
        assert_eq!(read, info);
    }
}
