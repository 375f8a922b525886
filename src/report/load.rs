//! A run, read back from its directory.

use crate::variant::Variant;
use std::path::{Path, PathBuf};

use anyhow::Result;

use super::curve::Contender;
use crate::record::read::{read_info, read_optional_rows, read_rows};
use crate::record::{
    BIAS_FILE, BiasRow, Cell, ERRORS_FILE, FrameError, IMAGES_DIR, ImageKind, MethodRecord,
    REGIONS_FILE, RUN_FILE, RegionRow, RunInfo, RunStatus, SAMPLES_FILE, SUMMARY_FILE, Sample,
    Status, Summary, SweepRecord, check_files, earlier_image_name, image_name,
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
    /// Every verified frame; empty where the run has no such file, as the next two.
    pub errors: Vec<FrameError>,
    /// The largest regions of artifacts.
    pub regions: Vec<RegionRow>,
    /// What searching for biases found.
    pub biases: Vec<BiasRow>,
    /// The run's own warnings, then what reading it had to work around.
    pub warnings: Vec<String>,
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
        warnings.extend(check_files(dir, RUN_FILE, &info.files)?);
        let samples: Vec<Sample> = read_rows(&dir.join(SAMPLES_FILE), cut_off, &mut warnings)?;
        let mut summaries: Vec<Summary> =
            read_rows(&dir.join(SUMMARY_FILE), cut_off, &mut warnings)?;
        let errors = read_optional_rows(&dir.join(ERRORS_FILE), cut_off, &mut warnings)?;
        summaries.extend(unsummed(&samples, &errors, &summaries));
        Ok(Self {
            dir: dir.to_owned(),
            errors,
            regions: read_optional_rows(&dir.join(REGIONS_FILE), cut_off, &mut warnings)?,
            biases: read_optional_rows(&dir.join(BIAS_FILE), cut_off, &mut warnings)?,
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
    /// The place of its [`Curve`](super::curve::Curve) among all curves decides its colour in every plot.
    pub fn contenders(&self) -> Vec<Contender> {
        let listed = self.info.methods.iter().map(|method| Contender {
            method: method.id.clone(),
            variant: method.variant.to_string(),
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

    /// The sweep that a contender is a point of.
    pub fn sweep_of(&self, contender: &Contender) -> Option<&SweepRecord> {
        let named = |record: &&MethodRecord| {
            record.id == contender.method && record.variant.as_str() == contender.variant
        };
        self.info
            .methods
            .iter()
            .filter(named)
            .find_map(|record| record.sweep.as_ref())
    }

    /// Name of a picture in the folder of pictures; there may be none.
    ///
    /// Runs of versions that gave scenes of different names one picture have it shown under neither.
    pub fn image(&self, scene: &str, method: &str, variant: &Variant, kind: ImageKind) -> String {
        let name = image_name(scene, method, variant, kind);
        let of = |scene: &str| earlier_image_name(scene, method, variant, kind);
        let earlier = of(scene);
        let is_there = |name: &str| self.dir.join(IMAGES_DIR).join(name).is_file();
        let is_shared = || {
            self.scenes()
                .iter()
                .filter(|other| of(other) == earlier)
                .count()
                > 1
        };
        if is_there(&name) || !self.info.files.is_empty() || is_shared() {
            name
        } else {
            earlier
        }
    }

    /// The verified frames that a row sums up.
    pub fn errors_of<'a>(&'a self, row: &'a Summary) -> impl Iterator<Item = &'a FrameError> {
        self.errors.iter().filter(|error| is_error_of(error, row))
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

    /// Why nothing of a scene was measured, if one reason says it for all methods: said once, not in every row.
    pub fn absence(&self, scene: &str) -> Option<(Status, &str)> {
        let mut rows = self.summaries.iter().filter(|row| row.scene == scene);
        let Some(first) = rows.next() else {
            let record = self
                .info
                .scenes
                .iter()
                .find(|record| record.name == scene)?;
            return Some((record.status, record.reason.as_str()));
        };
        let is_alike = |row: &Summary| (row.status, &row.reason) == (first.status, &first.reason);
        (first.is_absent() && rows.all(|row| row.is_absent() && is_alike(row)))
            .then_some((first.status, first.reason.as_str()))
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

pub(super) fn unique<T: PartialEq>(items: impl Iterator<Item = T>) -> Vec<T> {
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

fn is_error_of(error: &FrameError, row: &Summary) -> bool {
    error.scene == row.scene
        && error.method == row.method
        && error.variant == row.variant
        && (error.width, error.height) == (row.width, row.height)
}

/// Rows for the cells that have samples but were cut off before they were summed up.
fn unsummed(samples: &[Sample], errors: &[FrameError], summaries: &[Summary]) -> Vec<Summary> {
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
        let verified = errors.iter().filter(|e| is_error_of(e, &blank));
        let verified: Vec<FrameError> = verified.cloned().collect();
        let status = Status::Unverified;
        let reason = "the run was cut off in this cell";
        rows.push(Summary::from_samples(
            &cell, &own, &verified, status, reason,
        ));
    }
    rows
}
