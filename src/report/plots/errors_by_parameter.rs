//! Wrong pixels against a swept parameter: what a value costs or buys in accuracy alone.

use super::axis::Axis;
use super::legend::Key;
use super::lines::{Line, LineChart};
use super::{Chart, Figure};
use crate::file_name::file_name;
use crate::report::curve::{Contender, Curves};
use crate::report::load::Run;
use crate::report::pareto::{Cloud, Point};

/// How the name of each of these plots begins.
pub(in crate::report) const PREFIX: &str = "errors_by_";
/// How much of an axis is kept for zero.
const ZERO_BAND: f64 = 0.1;
/// Fewer values than this are no curve.
const FEWEST: usize = 3;
/// Dashes of the lines of artifacts.
const DASH_PX: i32 = 5;

/// A figure for each scene and swept parameter.
pub(super) fn figures(run: &Run, clouds: &[Cloud]) -> Vec<Figure> {
    let curves = Curves::of(run);
    let mut figures: Vec<Figure> = Vec::new();
    for cloud in clouds {
        let Some(scene) = &cloud.scene else { continue };
        let mut parameters: Vec<&str> = Vec::new();
        let swept = |point: &'_ Point| point.sweep.is_some();
        for point in cloud.points.iter().filter(|point| swept(point)) {
            let name = point.curve.parameter.as_deref().unwrap_or_default();
            if !parameters.contains(&name) {
                parameters.push(name);
            }
        }
        for parameter in parameters {
            let Some(chart) = chart(cloud, &curves, parameter) else {
                continue;
            };
            let mut name = format!("{PREFIX}{}_{}", file_name(parameter), file_name(scene));
            // Where a parameter ends and a scene begins, the name does not say.
            while figures.iter().any(|other| other.name == name) {
                name.push('-');
            }
            figures.push(Figure {
                name,
                title: format!("Wrong pixels by {parameter}, {}", run.scene_title(scene)),
                chart: Chart::Lines(chart),
            });
        }
    }
    figures
}

/// Lines of wrong pixels and, dashed, of the artifacts among them, for each curve of the parameter.
fn chart(cloud: &Cloud, curves: &Curves, parameter: &str) -> Option<LineChart> {
    let (mut lines, mut keys) = (Vec::new(), Vec::new());
    for (place, curve) in curves.all.iter().enumerate() {
        let on_curve = cloud.points.iter().filter(|point| point.curve == *curve);
        let valued = on_curve.filter_map(|point| Some((point.sweep.as_ref()?.value, point)));
        let mut points: Vec<(f64, &Point)> = valued.collect();
        if curve.parameter.as_deref() != Some(parameter) || points.len() < FEWEST {
            continue;
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let key = Key::of(place);
        let dashed = Key {
            dash_px: Some(DASH_PX),
            ..key
        };
        let line = |key: Key, px: fn(&Point) -> f64| Line {
            key,
            contender: curve.name.clone(),
            points: points
                .iter()
                .map(|(value, point)| (*value, px(point)))
                .collect(),
        };
        lines.push(line(dashed, artifacts_per_frame));
        lines.push(line(key, |point| point.wrong_px));
        keys.push((key, curve.name.clone()));
    }
    let black = |dash_px| Key {
        color: super::canvas::INK,
        marker: None,
        dash_px,
    };
    let artifacts = Contender::new("artifacts", "farther than 1 px from the edge");
    keys.push((black(None), Contender::new("wrong pixels", "all")));
    keys.push((black(Some(DASH_PX)), artifacts));
    let points = lines.iter().flat_map(|line| line.points.iter().copied());
    let (x, y): (Vec<f64>, Vec<f64>) = points.unzip();
    let title = "Pixels per verified frame, mean (log scale)";
    (!lines.is_empty()).then(|| LineChart {
        x: value_axis(parameter, &x),
        y: Axis::log_with_zero(title, y.into_iter(), ZERO_BAND),
        lines,
        keys,
    })
}

fn artifacts_per_frame(point: &Point) -> f64 {
    point.counts.artifact_px as f64 / f64::from(point.counts.verified_frames.max(1))
}

/// Logarithmic where values are far apart, with a place for zero; linear where some are below zero.
fn value_axis(parameter: &str, values: &[f64]) -> Axis {
    let positive = || values.iter().copied().filter(|value| *value > 0.0);
    let (low, high) = (
        positive().fold(f64::INFINITY, f64::min),
        positive().fold(0.0, f64::max),
    );
    if values.iter().any(|value| *value < 0.0) || high / low < 4.0 {
        return Axis::exact(parameter, values.iter().copied());
    }
    let title = format!("{parameter} (log scale)");
    Axis::log_with_zero(&title, values.iter().copied(), ZERO_BAND)
}
