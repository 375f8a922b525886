//! Writing a run directory.
//!
//! `samples.csv`, `errors.csv`, `regions.csv` and `bias.csv` grow row by row, each flushed as it comes, so that a run that dies keeps what it
//! has. Everything else is written to a temporary file and renamed: a file that is there is whole.

use super::record::{
    BIAS_FILE, BiasRow, ERRORS_FILE, FrameError, IMAGES_DIR, ImageKind, REGIONS_FILE, RUN_FILE,
    RegionRow, RunInfo, SAMPLES_FILE, SUMMARY_FILE, Sample, Summary, image_name,
};
use crate::output;
use anyhow::{Context, bail};
use serde::Serialize;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A CSV file that grows row by row.
struct Table {
    name: &'static str,
    path: PathBuf,
    /// Made with the first row, if not before.
    writer: Option<csv::Writer<File>>,
}

impl Table {
    fn new(dir: &Path, name: &'static str) -> Self {
        Self {
            name,
            path: dir.join(name),
            writer: None,
        }
    }

    /// Makes the file, also if no row should come.
    fn create(&mut self) -> anyhow::Result<&mut csv::Writer<File>> {
        let writer = match self.writer.take() {
            Some(writer) => writer,
            None => csv::Writer::from_writer(output::create(&self.path)?),
        };
        Ok(self.writer.insert(writer))
    }

    /// Appends rows and makes sure that they are there.
    fn append<T: Serialize>(&mut self, rows: &[T]) -> anyhow::Result<()> {
        if rows.is_empty() {
            return Ok(());
        }
        let name = self.name;
        let cannot = || format!("cannot write {name}");
        let writer = self.create()?;
        rows.iter()
            .try_for_each(|row| writer.serialize(row))
            .with_context(cannot)?;
        writer.flush().with_context(cannot)
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
pub(super) struct RunDir {
    path: PathBuf,
    samples: Table,
    errors: Table,
    regions: Table,
    biases: Table,
}

impl RunDir {
    /// Creates the directory; it must not hold anything yet.
    pub(super) fn create(path: &Path) -> anyhow::Result<Self> {
        new_directory(path)?;
        let images = path.join(IMAGES_DIR);
        std::fs::create_dir(&images)
            .with_context(|| format!("cannot create {}", images.display()))?;
        let mut samples = Table::new(path, SAMPLES_FILE);
        samples.create()?;
        Ok(Self {
            path: path.to_owned(),
            samples,
            errors: Table::new(path, ERRORS_FILE),
            regions: Table::new(path, REGIONS_FILE),
            biases: Table::new(path, BIAS_FILE),
        })
    }

    /// Writes `run.json`, over the one before.
    pub(super) fn write_info(&self, info: &RunInfo) -> anyhow::Result<()> {
        self.replace(RUN_FILE, |file| {
            Ok(serde_json::to_writer_pretty(file, info)?)
        })
    }

    /// Appends a row to `samples.csv`.
    pub(super) fn append_sample(&mut self, sample: &Sample) -> anyhow::Result<()> {
        self.samples.append(std::slice::from_ref(sample))
    }

    /// Appends a verified frame to `errors.csv`, and its largest regions to `regions.csv`.
    pub(super) fn append_errors(
        &mut self,
        error: &FrameError,
        regions: &[RegionRow],
    ) -> anyhow::Result<()> {
        self.errors.append(std::slice::from_ref(error))?;
        self.regions.append(regions)
    }

    /// Appends a row to `bias.csv`.
    pub(super) fn append_bias(&mut self, bias: &BiasRow) -> anyhow::Result<()> {
        self.biases.append(std::slice::from_ref(bias))
    }

    /// Writes `summary.csv`, over the one before.
    pub(super) fn write_summary(&self, rows: &[Summary]) -> anyhow::Result<()> {
        self.replace(SUMMARY_FILE, |file| {
            let mut writer = csv::Writer::from_writer(file);
            rows.iter().try_for_each(|row| writer.serialize(row))?;
            Ok(writer.flush()?)
        })
    }

    /// Writes a picture of a cell.
    pub(super) fn write_image(
        &self,
        (scene, method, variant): (&str, &str, &str),
        kind: ImageKind,
        image: &crate::image::Image<'_>,
    ) -> anyhow::Result<()> {
        let name = image_name(scene, method, variant, kind);
        image.write_png(&self.path.join(IMAGES_DIR).join(name))
    }

    fn replace(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        output::write_with(&self.path.join(name), write)
    }
}
