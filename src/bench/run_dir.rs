//! Writing a run directory.
//!
//! `samples.csv` and `errors.csv` grow row by row, each flushed as measured, so that a run that dies keeps what it
//! has. Everything else is written to a temporary file and renamed: a file that is there is whole.

use super::record::{
    ERRORS_FILE, FrameError, IMAGES_DIR, ImageKind, RUN_FILE, RunInfo, SAMPLES_FILE, SUMMARY_FILE,
    Sample, Summary, image_name,
};
use anyhow::{Context, bail};
use std::fs::File;
use std::path::{Path, PathBuf};

/// An open run directory.
pub(super) struct RunDir {
    path: PathBuf,
    samples: csv::Writer<File>,
    errors: csv::Writer<File>,
}

impl RunDir {
    /// Creates the directory; it must not hold anything yet.
    pub(super) fn create(path: &Path) -> anyhow::Result<Self> {
        if path.is_dir() && path.read_dir()?.next().is_some() {
            bail!(
                "{} is not empty: choose another directory with --out",
                path.display()
            );
        }
        let images = path.join(IMAGES_DIR);
        std::fs::create_dir_all(&images)
            .with_context(|| format!("cannot create {}", images.display()))?;
        let table = |name| {
            let path = path.join(name);
            csv::Writer::from_path(&path)
                .with_context(|| format!("cannot create {}", path.display()))
        };
        Ok(Self {
            path: path.to_owned(),
            samples: table(SAMPLES_FILE)?,
            errors: table(ERRORS_FILE)?,
        })
    }

    /// Writes `run.json`, over the one before.
    pub(super) fn write_info(&self, info: &RunInfo) -> anyhow::Result<()> {
        self.replace(RUN_FILE, |file| {
            Ok(serde_json::to_writer_pretty(file, info)?)
        })
    }

    /// Appends a row to `samples.csv` and makes sure that it is there.
    pub(super) fn append(&mut self, sample: &Sample) -> anyhow::Result<()> {
        self.samples.serialize(sample)?;
        self.samples.flush().context("cannot write samples.csv")
    }

    /// Appends a row to `errors.csv` and makes sure that it is there.
    pub(super) fn append_error(&mut self, error: &FrameError) -> anyhow::Result<()> {
        self.errors.serialize(error)?;
        self.errors.flush().context("cannot write errors.csv")
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
        write: impl FnOnce(&mut File) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        crate::image::replace_file(&self.path.join(name), write)
    }
}
