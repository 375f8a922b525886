//! `pareto.csv`: every point of every chart.

use std::path::Path;

use anyhow::{Context as _, Result};
use serde::Serialize;

use super::{Cloud, PARETO_FILE, Point};
use crate::output::{remove_stale, write_atomically};
use crate::report::curve::Curve;
use crate::table::text;

/// What stands for the scene in rows over all scenes.
const ALL_SCENES: &str = "*";

/// A row of the file. The columns that `summary.csv` has too hold the same text there; for rows over all
/// scenes, see [`Point`].
#[derive(Debug, Serialize)]
struct Row<'a> {
    scene: &'a str,
    method: &'a str,
    variant: &'a str,
    curve: String,
    swept_parameter: &'a str,
    swept_value: Option<f64>,
    shadow_ms_median: f64,
    shadow_ms_p05: Option<f64>,
    shadow_ms_p95: Option<f64>,
    false_lit: u64,
    false_shadowed: u64,
    artifact_px: u64,
    verified_frames: u32,
    wrong_px_per_frame: f64,
    wrong_px_p05: Option<f64>,
    wrong_px_p95: Option<f64>,
    front: bool,
    dominated_by: String,
}

/// Writes the points into `dir`; without any, removes what an earlier report wrote.
pub(in crate::report) fn write(dir: &Path, clouds: &[Cloud]) -> Result<()> {
    let path = dir.join(PARETO_FILE);
    if clouds.is_empty() {
        return remove_stale(&path);
    }
    let contents = csv(clouds).with_context(|| format!("cannot make {PARETO_FILE}"))?;
    write_atomically(&path, &contents)
}

fn csv(clouds: &[Cloud]) -> Result<Vec<u8>> {
    let mut rows = Vec::new();
    // Scenes first, as in the summary; the rows over all of them last.
    let (overall, scenes): (Vec<&Cloud>, Vec<&Cloud>) =
        clouds.iter().partition(|cloud| cloud.scene.is_none());
    for cloud in scenes.into_iter().chain(overall) {
        for point in &cloud.points {
            rows.push(row(cloud, point));
        }
    }
    text(&rows)
}

fn row<'a>(cloud: &'a Cloud, point: &'a Point) -> Row<'a> {
    let dominator = point
        .dominated_by
        .map(|by| cloud.points[by].contender.label());
    Row {
        scene: cloud.scene.as_deref().unwrap_or(ALL_SCENES),
        method: &point.contender.method,
        variant: &point.contender.variant,
        curve: curve_name(&point.curve),
        swept_parameter: point.sweep.as_ref().map_or("", |sweep| &sweep.parameter),
        swept_value: point.sweep.as_ref().map(|sweep| sweep.value),
        shadow_ms_median: point.shadow_ms,
        shadow_ms_p05: point.shadow_ms_range.map(|range| range.0),
        shadow_ms_p95: point.shadow_ms_range.map(|range| range.1),
        false_lit: point.counts.false_lit,
        false_shadowed: point.counts.false_shadowed,
        artifact_px: point.counts.artifact_px,
        verified_frames: point.counts.verified_frames,
        wrong_px_per_frame: point.wrong_px,
        wrong_px_p05: point.wrong_px_range.map(|range| range.0),
        wrong_px_p95: point.wrong_px_range.map(|range| range.1),
        front: point.dominated_by.is_none(),
        dominated_by: dominator.unwrap_or_default(),
    }
}

/// The name of a sweep's curve; empty for a contender alone, which has none.
fn curve_name(curve: &Curve) -> String {
    curve
        .parameter
        .as_ref()
        .map_or_else(String::new, |_| curve.name.label())
}
