//! A run, read back from its directory.

use super::counter_rows::join_counters;
use super::read::{read_info, read_optional_rows, read_rows};
use super::stage_rows::join_stages;
use super::statistics::median;
use super::verified_frame::verified_frames;
use super::volume_rows::{VolumeRow, join_volumes};
use super::{
    BIAS_FILE, BiasRow, COUNTERS_FILE, Cell, CounterRow, IMAGES_DIR, ImageKind, METRICS_FILE,
    MetricRow, REGIONS_FILE, RUN_FILE, RegionRow, RunInfo, RunStatus, SAMPLES_FILE, STAGES_FILE,
    SUMMARY_FILE, Sample, SceneRecord, StageRow, Status, Summary, VOLUMES_FILE, VerifiedFrame,
    check_files, earlier_image_name, format1, image_name,
};
use crate::frame::DrawnVolumes;
use crate::metrics::{METRICS, MetricValues};
use crate::variant::Variant;
use anyhow::Result;
use std::path::{Path, PathBuf};

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
    pub frames: Vec<VerifiedFrame>,
    /// The largest regions of artifacts.
    pub regions: Vec<RegionRow>,
    /// What searching for biases found.
    pub biases: Vec<BiasRow>,
    /// The run's own warnings, then what reading it had to work around.
    pub warnings: Vec<String>,
}

impl Run {
    /// Whether its pictures have the size of its scene's, or of the run's where the scene has none of its own.
    pub fn is_of_own_size(&self, row: &Summary) -> bool {
        let mut scenes = self.info.scenes.iter();
        let of_scene = scenes.find(|scene| scene.name == row.scene);
        let of_scene = of_scene.and_then(|scene| scene.size_px);
        (row.width, row.height) == of_scene.unwrap_or((self.info.width, self.info.height))
    }

    /// Reads the run directory `dir`, of this format or an earlier one.
    ///
    /// A run that was cut off is read as far as it goes: missing tables are empty, a torn last row
    /// is left out, and cells that were measured but not summed up count as unverified.
    ///
    /// # Errors
    /// When a file is missing or broken; the message names it and the line.
    pub fn read(dir: &Path) -> Result<Self> {
        let info = read_info(dir)?;
        let mut warnings = info.warnings.clone();
        let cut_off = info.status != RunStatus::Complete;
        warnings.extend(check_files(dir, RUN_FILE, &info.files)?);
        let mut samples: Vec<Sample> = read_rows(&dir.join(SAMPLES_FILE), cut_off, &mut warnings)?;
        let mut summaries: Vec<Summary> =
            read_rows(&dir.join(SUMMARY_FILE), cut_off, &mut warnings)?;
        let frames = if info.format < 2 {
            format1::unpack_stages(dir, cut_off, &mut samples)?;
            format1::unpack_counters(dir, cut_off, &mut summaries)?;
            format1::read_frames(dir, cut_off, &mut warnings)?
        } else {
            let stages: Vec<StageRow> =
                read_optional_rows(&dir.join(STAGES_FILE), cut_off, &mut warnings)?;
            join_stages(&mut samples, stages);
            let volumes: Vec<VolumeRow> =
                read_optional_rows(&dir.join(VOLUMES_FILE), cut_off, &mut warnings)?;
            join_volumes(&mut samples, volumes);
            let counters: Vec<CounterRow> =
                read_optional_rows(&dir.join(COUNTERS_FILE), cut_off, &mut warnings)?;
            join_counters(&mut summaries, &counters);
            read_frames(dir, cut_off, &mut warnings)?
        };
        for row in &mut summaries {
            let own = frames.iter().filter(|frame| is_frame_of(frame, row));
            row.metrics = MetricValues::over_frames(METRICS, own.map(|frame| &frame.metrics));
        }
        summaries.extend(unsummed(&samples, &frames, &summaries));
        Ok(Self {
            dir: dir.to_owned(),
            frames,
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

    /// A scene by its name in results.
    pub fn scene(&self, name: &str) -> Option<&SceneRecord> {
        self.info.scenes.iter().find(|scene| scene.name == name)
    }

    /// The scene's name for people; its plain name where the run has no other.
    pub fn scene_title<'a>(&'a self, name: &'a str) -> &'a str {
        match self.scene(name) {
            Some(SceneRecord { title, .. }) if !title.is_empty() => title,
            _ => name,
        }
    }

    /// Why nothing of a scene was measured, if one reason says it for all methods: said once, not in every row.
    pub fn absence(&self, scene: &str) -> Option<(Status, &str)> {
        let mut rows = self.summaries.iter().filter(|row| row.scene == scene);
        let Some(first) = rows.next() else {
            let record = self.scene(scene)?;
            return Some((record.status, &record.reason));
        };
        let is_alike = |row: &Summary| (row.status, &row.reason) == (first.status, &first.reason);
        (first.is_absent() && rows.all(|row| row.is_absent() && is_alike(row)))
            .then_some((first.status, &*first.reason))
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
    pub fn frames_of<'a>(&'a self, row: &'a Summary) -> impl Iterator<Item = &'a VerifiedFrame> {
        self.frames.iter().filter(|frame| is_frame_of(frame, row))
    }

    /// The samples that a row sums up.
    pub fn samples_of<'a>(&'a self, row: &'a Summary) -> impl Iterator<Item = &'a Sample> {
        self.samples.iter().filter(|sample| is_of(sample, row))
    }

    /// The stages of a cell and the medians of what they took on both clocks, in milliseconds.
    pub fn stage_medians<'a>(&'a self, row: &'a Summary) -> Vec<(&'a str, f64)> {
        let stages = || self.samples_of(row).flat_map(|sample| &sample.stages);
        let names = unique(stages().map(|stage| stage.stage.as_str()));
        let of = |name| {
            let own = stages().filter(|stage| stage.stage == name);
            let times_ms: Vec<f64> = own.map(|stage| stage.device_ms + stage.cpu_ms).collect();
            Some((name, median(&times_ms)?))
        };
        names.into_iter().filter_map(of).collect()
    }

    /// What a cell's frames drew of its volumes on average: objects drawn, culled and hidden, queries, and milliseconds of
    /// waiting. `None` for a method without volumes.
    pub fn mean_volumes(&self, row: &Summary) -> Option<[f64; 5]> {
        let (mut sum, mut wait_ms, mut frames) = (DrawnVolumes::default(), 0.0, 0);
        for sample in self.samples_of(row) {
            sum += sample.volumes?;
            wait_ms += sample.wait_ms;
            frames += 1;
        }
        let [drawn, culled, hidden, queries] =
            [sum.drawn(), sum.culled, sum.hidden, sum.queries].map(f64::from);
        let sums = [drawn, culled, hidden, queries, wait_ms];
        (frames > 0).then(|| sums.map(|sum| sum / f64::from(frames)))
    }
}

/// Reads `metrics.csv`. Of a frame whose rows are torn, none is kept.
fn read_frames(
    dir: &Path,
    cut_off: bool,
    warnings: &mut Vec<String>,
) -> Result<Vec<VerifiedFrame>> {
    let before = warnings.len();
    let rows: Vec<MetricRow> = read_optional_rows(&dir.join(METRICS_FILE), cut_off, warnings)?;
    let mut frames = verified_frames(rows);
    if warnings.len() > before {
        frames.pop();
    }
    Ok(frames)
}

pub(crate) fn unique<T: PartialEq>(items: impl Iterator<Item = T>) -> Vec<T> {
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

fn is_frame_of(frame: &VerifiedFrame, row: &Summary) -> bool {
    frame.scene == row.scene
        && frame.method == row.method
        && frame.variant == row.variant
        && (frame.width, frame.height) == (row.width, row.height)
}

/// Rows for the cells that have samples but were cut off before they were summed up.
fn unsummed(samples: &[Sample], frames: &[VerifiedFrame], summaries: &[Summary]) -> Vec<Summary> {
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
        let verified = frames.iter().filter(|e| is_frame_of(e, &blank));
        let verified: Vec<VerifiedFrame> = verified.cloned().collect();
        let status = Status::Unverified;
        let reason = "the run was cut off in this cell";
        rows.push(Summary::from_samples(
            &cell, &own, &verified, status, reason,
        ));
    }
    rows
}
