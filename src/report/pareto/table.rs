//! `pareto.csv`: every point of every chart.

use std::path::Path;

use anyhow::{Context as _, Result};
use serde::Serialize;

use super::{Cloud, PARETO_FILE, Point};
use crate::output::{remove_stale, write_atomically};
use crate::table::text_under;

/// The columns. Those that `summary.csv` has too hold the same text there; for rows over all scenes, see [`Point`].
const HEAD: &str = "scene,method,variant,curve,swept_parameter,swept_value,shadow_ms_median,shadow_ms_p05,\
    shadow_ms_p95,false_lit,false_shadowed,artifact_px,verified_frames,wrong_px_per_frame,wrong_px_p05,wrong_px_p95,\
    front,dominated_by";
/// What stands for the scene in rows over all scenes.
const ALL_SCENES: &str = "*";

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
    // Scenes first, as in the summary; the rows over all of them last.
    let (overall, scenes): (Vec<&Cloud>, Vec<&Cloud>) =
        clouds.iter().partition(|cloud| cloud.scene.is_none());
    let mut rows = Vec::new();
    for cloud in scenes.into_iter().chain(overall) {
        rows.extend(cloud.points.iter().map(|point| row(cloud, point)));
    }
    text_under(HEAD.split(',').collect(), &rows)
}

fn row<'a>(cloud: &'a Cloud, point: &'a Point) -> impl Serialize + use<'a> {
    let Point {
        contender,
        curve,
        counts,
        dominated_by: by,
        ..
    } = point;
    // A contender alone has no curve.
    let curve_name = curve.parameter.as_ref().map(|_| curve.name.label());
    (
        cloud.scene.as_deref().unwrap_or(ALL_SCENES),
        (&contender.method, &contender.variant),
        (curve_name, &curve.parameter),
        point.sweep.as_ref().map(|sweep| sweep.value),
        (point.shadow_ms, point.shadow_ms_range.unzip()),
        (counts.false_lit, counts.false_shadowed),
        (counts.artifact_px, counts.verified_frames),
        (point.wrong_px, point.wrong_px_range.unzip()),
        by.is_none(),
        by.map(|by| cloud.points[by].contender.label()),
    )
}
