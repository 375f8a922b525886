//! Shadow time along the flight: where a method pays, and whether it pays evenly.

use std::collections::BTreeMap;

use super::axis::Axis;
use super::chosen::Chosen;
use super::lines::{Line, LineChart};
use super::{Chart, Figure};
use crate::file_name::file_name;
use crate::record::Summary;
use crate::record::statistics::median;
use crate::report::load::Run;

/// A figure per scene in which at least two frames were measured.
pub(super) fn figures(run: &Run) -> Vec<Figure> {
    let chosen = Chosen::of(run);
    run.scenes()
        .into_iter()
        .filter_map(|scene| figure(run, scene, &chosen))
        .collect()
}

fn figure(run: &Run, scene: &str, chosen: &Chosen) -> Option<Figure> {
    let mut lines = Vec::new();
    for row in run.rows(scene) {
        let contender = run.contender(row);
        let Some(key) = chosen.key(&contender) else {
            continue;
        };
        let points = along_flight(run, row);
        if points.len() >= 2 {
            lines.push(Line {
                key,
                contender,
                points,
            });
        }
    }
    if lines.is_empty() {
        return None;
    }
    let points = lines.iter().flat_map(|line| line.points.iter().copied());
    let x = Axis::exact(
        "Time along the flight, s",
        points.clone().map(|point| point.0),
    );
    let y = Axis::fit("Shadow time, ms", points.map(|point| point.1));
    Some(Figure {
        name: format!("flight_{}", file_name(scene)),
        title: format!(
            "Shadow time along the flight, {}{}",
            run.scene_title(scene),
            chosen.remark
        ),
        chart: Chart::Lines(LineChart {
            x,
            y,
            lines,
            keys: Vec::new(),
        }),
    })
}

/// Time on the flight and shadow time, a point per frame; the median where a frame was measured more
/// than once.
fn along_flight(run: &Run, row: &Summary) -> Vec<(f64, f64)> {
    let mut frames: BTreeMap<u32, (f64, Vec<f64>)> = BTreeMap::new();
    for sample in run.samples_of(row) {
        let (_, shadow_ms) = frames
            .entry(sample.frame)
            .or_insert_with(|| (sample.time_s, Vec::new()));
        shadow_ms.push(sample.shadow_ms);
    }
    frames
        .into_values()
        .filter_map(|(time_s, all)| Some((time_s, median(&all)?)))
        .collect()
}
