//! The rows of `samples.csv` and `summary.csv`.

use crate::frame::DrawnVolumes;
use crate::variant::Variant;
use serde::{Deserialize, Serialize};

use super::{Cell, Status, VerifiedFrame};
use crate::metrics::{METRICS, MetricValues};
use crate::record::statistics::{mean, median, p95};
use crate::table;

/// How long a stage of a method took in one frame.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StageMs {
    /// Its name.
    pub stage: String,
    /// On the device, in milliseconds.
    pub device_ms: f64,
    /// On the processor, in milliseconds.
    pub cpu_ms: f64,
}

/// One measured frame: a row of `samples.csv`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Name of the scene.
    pub scene: String,
    /// Triangles that cast.
    pub triangles: u64,
    /// Objects that cast.
    pub objects: u64,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: Variant,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Number of the frame along the flight, from zero.
    pub frame: u32,
    /// Where on the flight the frame lies, in seconds.
    pub time_s: f64,
    /// Position of this frame in the order in which its scene's frames were drawn, warm-up included.
    pub order: u64,
    /// The frame's critical path over both clocks, in milliseconds.
    pub frame_ms: f64,
    /// The G-buffer.
    pub gbuffer_ms: f64,
    /// What the method adds: everything but G-buffer and shading.
    pub shadow_ms: f64,
    /// Shading.
    pub shade_ms: f64,
    /// Recording and submitting, on the processor.
    pub cpu_ms: f64,
    /// Recording alone; 0 in runs from before it was measured.
    #[serde(default)]
    pub record_ms: f64,
    /// Draw calls of the frame; 0 in runs from before they were counted.
    #[serde(default)]
    pub draw_calls: u32,
    /// The part of `shadow_ms` that passed on the device.
    #[serde(default)]
    pub shadow_device_ms: f64,
    /// The part of `shadow_ms` that passed on the processor; 0 in runs from before it was measured.
    #[serde(default)]
    pub shadow_cpu_ms: f64,
    /// How long the processor waited within the frame for answers of the device; on no clock. 0 in runs from before it was
    /// measured.
    #[serde(default)]
    pub wait_ms: f64,
    /// The method's stages, which stand in `stages.csv`.
    #[serde(skip)]
    pub stages: Vec<StageMs>,
    /// How its volumes were drawn, which stands in `volumes.csv`; `None` of methods without volumes.
    #[serde(skip)]
    pub volumes: Option<DrawnVolumes>,
}

/// One cell: a row of `summary.csv`. Numbers are `None`, and their fields empty, where nothing was
/// measured; error counts are sums over the verified frames, empty where there was none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// Triangles that cast.
    pub triangles: Option<u64>,
    /// Objects that cast.
    pub objects: Option<u64>,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: Variant,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Frames measured.
    pub frames: u32,
    /// Frames by their summed time, as the literature has it: the reciprocal of the mean frame.
    pub fps: Option<f64>,
    /// Median of the frame time.
    pub frame_ms_median: Option<f64>,
    /// Median of the shadow time.
    pub shadow_ms_median: Option<f64>,
    /// 95th percentile of the shadow time.
    pub shadow_ms_p95: Option<f64>,
    /// Median of the G-buffer's time.
    pub gbuffer_ms_median: Option<f64>,
    /// The metric of that name.
    pub false_lit: Option<u64>,
    /// The metric of that name.
    pub false_shadowed: Option<u64>,
    /// The metric of that name.
    pub artifact_px: Option<u64>,
    /// The metric of that name.
    pub ambiguous_px: Option<u64>,
    /// What became of the cell.
    pub status: Status,
    /// Why, where it is not [`Status::Ok`].
    pub reason: String,
    /// The metric of that name.
    pub boundary_px: Option<u64>,
    /// Frames compared with the reference.
    pub verified_frames: u32,
    /// 95th percentile of the frame time.
    pub frame_ms_p95: Option<f64>,
    /// Median of the processor's time for a frame.
    pub cpu_ms_median: Option<f64>,
    /// Mean of the frame time.
    pub frame_ms_mean: Option<f64>,
    /// Median of the time for recording a frame on the processor.
    #[serde(default)]
    pub record_ms_median: Option<f64>,
    /// Most draw calls of any measured frame.
    #[serde(default)]
    pub draw_calls: Option<u32>,
    /// See [`Cell::counters`]; they stand in `counters.csv`.
    #[serde(skip)]
    pub counters: Vec<(String, u64)>,
    /// What the verified frames have together; one column for each metric follows in `summary.csv`.
    #[serde(skip)]
    pub metrics: MetricValues,
}

impl Summary {
    /// Whether nothing of it was measured, for the reason that it gives.
    pub fn is_absent(&self) -> bool {
        self.status.is_absent() && self.frames == 0
    }

    /// Sums up the measured and the verified frames of one cell.
    pub fn from_samples(
        cell: &Cell,
        samples: &[Sample],
        frames: &[VerifiedFrame],
        status: Status,
        reason: &str,
    ) -> Self {
        let column = |of: fn(&Sample) -> f64| samples.iter().map(of).collect::<Vec<f64>>();
        let frame_ms = column(|s| s.frame_ms);
        let shadow_ms = column(|s| s.shadow_ms);
        let total_ms: f64 = frame_ms.iter().sum();
        let metrics = frames.iter().map(|frame| &frame.metrics);
        let metrics = MetricValues::over_frames(METRICS, metrics);
        Self {
            scene: cell.scene.clone(),
            triangles: cell.triangles,
            objects: cell.objects,
            method: cell.method.clone(),
            variant: cell.variant.clone(),
            width: cell.width,
            height: cell.height,
            frames: u32::try_from(samples.len()).unwrap_or(u32::MAX),
            fps: (total_ms > 0.0).then(|| samples.len() as f64 * 1000.0 / total_ms),
            frame_ms_median: median(&frame_ms),
            shadow_ms_median: median(&shadow_ms),
            shadow_ms_p95: p95(&shadow_ms),
            gbuffer_ms_median: median(&column(|s| s.gbuffer_ms)),
            false_lit: metrics.px("false_lit"),
            false_shadowed: metrics.px("false_shadowed"),
            artifact_px: metrics.px("artifact_px"),
            ambiguous_px: metrics.px("ambiguous_px"),
            status,
            reason: reason.to_owned(),
            boundary_px: metrics.px("boundary_px"),
            verified_frames: u32::try_from(frames.len()).unwrap_or(u32::MAX),
            frame_ms_p95: p95(&frame_ms),
            cpu_ms_median: median(&column(|s| s.cpu_ms)),
            frame_ms_mean: mean(&frame_ms),
            record_ms_median: median(&column(|s| s.record_ms)),
            draw_calls: samples.iter().map(|s| s.draw_calls).max(),
            counters: cell.counters.clone(),
            metrics,
        }
    }
}

/// `summary.csv`: a header and a record for each cell, with a column for each metric that has no classes.
///
/// # Errors
/// When a row is none.
pub fn summary_records(rows: &[Summary]) -> anyhow::Result<Vec<csv::StringRecord>> {
    let mut records = table::records(rows)?;
    let has = |records: &[csv::StringRecord], name: &str| {
        let mut header = records.iter().take(1).flatten();
        header.any(|known| known == name)
    };
    for metric in METRICS {
        let Some(column) = metric.column().filter(|column| !has(&records, column)) else {
            continue;
        };
        let values = rows.iter().map(|row| row.metrics.get(metric.name));
        let values = values.map(|value| value.map_or(String::new(), |value| value.to_string()));
        let fields = std::iter::once(column).chain(values);
        for (record, field) in records.iter_mut().zip(fields) {
            record.push_field(&field);
        }
    }
    Ok(records)
}

#[cfg(test)]
#[path = "rows_tests.rs"]
mod tests;
