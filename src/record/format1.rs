//! Tables of the first format, which packed several numbers into one field: `volumes=12.3;resolve=0.4`.

use super::read::{read_optional_rows, read_rows};
use super::{SAMPLES_FILE, SUMMARY_FILE, Sample, StageMs, Summary, VerifiedFrame};
use crate::metrics::MetricValues;
use crate::variant::Variant;
use anyhow::Result;
use serde::Deserialize;
use std::path::Path;
use std::str::FromStr;

/// What is now `metrics.csv`.
const ERRORS_FILE: &str = "errors.csv";

#[derive(Deserialize)]
struct PackedStages {
    #[serde(default)]
    stages: String,
}

#[derive(Deserialize)]
struct PackedCounters {
    #[serde(default)]
    counters: String,
}

#[derive(Deserialize)]
struct PackedErrors {
    scene: String,
    method: String,
    variant: Variant,
    width: u32,
    height: u32,
    frame: u32,
    time_s: f64,
    false_lit: u64,
    false_shadowed: u64,
    boundary_px: u64,
    artifact_px: u64,
    ambiguous_px: u64,
    compared_px: u64,
    distances: String,
    distance_px_max: Option<f64>,
    regions: u64,
    largest_region_px: u64,
    labels: String,
    followed_px: Option<u64>,
    flicker_px: Option<u64>,
    flip: Option<f64>,
}

/// Numbers by name; a part that is not `name=number` is left out.
fn unpack<T: FromStr>(text: &str) -> impl Iterator<Item = (String, T)> {
    text.split(';')
        .filter_map(|part| part.rsplit_once('='))
        .filter_map(|(name, number)| Some((name.to_owned(), number.parse().ok()?)))
}

/// Gives samples their stages, and the time on the only clock that there was.
pub(super) fn unpack_stages(dir: &Path, cut_off: bool, samples: &mut [Sample]) -> Result<()> {
    let path = dir.join(SAMPLES_FILE);
    let packed: Vec<PackedStages> = read_rows(&path, cut_off, &mut Vec::new())?;
    for (sample, packed) in samples.iter_mut().zip(packed) {
        let stage = |(stage, device_ms)| StageMs {
            stage,
            device_ms,
            cpu_ms: 0.0,
        };
        sample.stages = unpack(&packed.stages).map(stage).collect();
        sample.shadow_device_ms = sample.shadow_ms;
    }
    Ok(())
}

/// Gives cells their counters.
pub(super) fn unpack_counters(dir: &Path, cut_off: bool, cells: &mut [Summary]) -> Result<()> {
    let path = dir.join(SUMMARY_FILE);
    let packed: Vec<PackedCounters> = read_rows(&path, cut_off, &mut Vec::new())?;
    for (cell, packed) in cells.iter_mut().zip(packed) {
        cell.counters = unpack(&packed.counters).collect();
    }
    Ok(())
}

/// Reads the verified frames, if there are any.
pub(super) fn read_frames(
    dir: &Path,
    cut_off: bool,
    warnings: &mut Vec<String>,
) -> Result<Vec<VerifiedFrame>> {
    let rows = read_optional_rows(&dir.join(ERRORS_FILE), cut_off, warnings)?;
    Ok(rows.into_iter().map(frame).collect())
}

fn frame(row: PackedErrors) -> VerifiedFrame {
    let counts = [
        ("false_lit", row.false_lit),
        ("false_shadowed", row.false_shadowed),
        ("boundary_px", row.boundary_px),
        ("artifact_px", row.artifact_px),
        ("ambiguous_px", row.ambiguous_px),
        ("compared_px", row.compared_px),
        ("regions", row.regions),
        ("largest_region_px", row.largest_region_px),
    ];
    let others = [
        ("distance_px_max", row.distance_px_max),
        ("followed_px", row.followed_px.map(|px| px as f64)),
        ("flicker_px", row.flicker_px.map(|px| px as f64)),
        ("flip", row.flip),
    ];
    let classes = |name: &'static str, text: &str| {
        let named = move |(class, px): (String, f64)| (format!("{name}.{class}"), px);
        unpack(text).map(named).collect::<Vec<_>>()
    };
    let counts = counts.map(|(name, count)| (name.to_owned(), count as f64));
    let others = others.map(|(name, value)| Some((name.to_owned(), value?)));
    let metrics: MetricValues = counts
        .into_iter()
        .chain(classes("distance", &row.distances))
        .chain(classes("label", &row.labels))
        .chain(others.into_iter().flatten())
        .collect();
    VerifiedFrame {
        scene: row.scene,
        method: row.method,
        variant: row.variant,
        width: row.width,
        height: row.height,
        frame: row.frame,
        time_s: row.time_s,
        metrics,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_fields_are_unpacked_and_damage_is_left_out() {
        let stages: Vec<(String, f64)> = unpack("volumes=12.3;broken;half=;resolve=0.4").collect();
        let expected = [("volumes", 12.3), ("resolve", 0.4)];
        assert_eq!(stages, expected.map(|(name, ms)| (name.to_owned(), ms)));
        assert_eq!(unpack::<u64>("").count(), 0);
    }

    #[test]
    fn frames_of_the_first_format_have_all_their_metrics() {
        let room = tempfile::tempdir().unwrap();
        let text = "scene,method,variant,width,height,frame,time_s,false_lit,false_shadowed,boundary_px,artifact_px,\
            ambiguous_px,compared_px,distances,distance_px_max,regions,largest_region_px,labels,followed_px,\
            flicker_px,flip\n\
            sponza,shadow_map,pcf=3,8,4,1,0.5,3,4,5,2,1,31,1=5;more=2,7.5,2,1,acne=2,20,,0.25\n";
        std::fs::write(room.path().join(ERRORS_FILE), text).unwrap();
        let frames = read_frames(room.path(), false, &mut Vec::new()).unwrap();
        let frame = &frames[0];
        assert_eq!((frame.variant.as_str(), frame.frame), ("pcf=3", 1));
        assert_eq!((frame.wrong_px(), frame.px("ambiguous_px")), (7, 1));
        let classes: Vec<_> = frame.metrics.classes("distance").collect();
        assert_eq!(classes, [("1", 5), ("more", 2)]);
        assert_eq!(frame.px("label.acne"), 2);
        assert_eq!(frame.metrics.get("flip"), Some(0.25));
        assert_eq!(frame.metrics.get("distance_px_max"), Some(7.5));
        assert_eq!(frame.metrics.get("flicker_px"), None);
    }
}
