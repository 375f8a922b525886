//! Shadow time against wrong pixels: a chart for each scene, and one over all of them.

use super::axis::Axis;
use super::canvas::shortened;
use super::legend::Key;
use super::scatter::{CurveLine, Dot, ScatterChart};
use super::{Chart, Figure};
use crate::file_name::file_name;
use crate::record::SweepRecord;
use crate::report::curve::Curves;
use crate::report::load::Run;
use crate::report::pareto::{Cloud, Point};

/// How the name of each of these plots begins.
pub(in crate::report) const PREFIX: &str = "pareto_";
/// What stands for the scene in the name of the plot over all of them.
const ALL: &str = "all";
/// How much of an axis is kept for zero.
const ZERO_BAND: f64 = 0.14;
/// Enough for a method with a parameter; longer ones lose their middle.
const NAME_CHARS: usize = 46;
const CURVE_NAME_CHARS: usize = 60;
/// A swept parameter with a name this short stands before its value: `pcf 3`, but `1024`.
const SHORT_PARAMETER: usize = 4;

pub(super) fn figures(run: &Run, clouds: &[Cloud]) -> Vec<Figure> {
    let curves = Curves::of(run);
    let figure = |cloud| figure(run, cloud, &curves);
    clouds.iter().map(figure).collect()
}

fn figure(run: &Run, cloud: &Cloud, curves: &Curves) -> Figure {
    let (name, place) = match &cloud.scene {
        // Not the name of the plot over all scenes.
        Some(scene) if scene == ALL => (format!("{ALL}~scene"), run.scene_title(scene)),
        Some(scene) => (file_name(scene), run.scene_title(scene)),
        None => (ALL.to_owned(), "over all scenes"),
    };
    Figure {
        name: format!("{PREFIX}{name}"),
        title: format!("Accuracy against speed, {place}"),
        chart: Chart::Scatter(chart(cloud, curves)),
    }
}

fn chart(cloud: &Cloud, curves: &Curves) -> ScatterChart {
    let over_all = cloud.scene.is_none();
    let (x, y, interval) = if over_all {
        (
            "Shadow time, geometric mean of the scenes' medians, ms (log scale)",
            "Wrong pixels per verified frame, mean of the scenes (log scale)",
            "least to greatest of the scenes",
        )
    } else {
        (
            "Shadow time, median, ms (log scale)",
            "Wrong pixels per verified frame, mean (log scale)",
            "5th to 95th percentile of the frames",
        )
    };
    let points = &cloud.points;
    ScatterChart {
        x: axis(x, points, |p| (p.shadow_ms, p.shadow_ms_range)),
        y: axis(y, points, |p| (p.wrong_px, p.wrong_px_range)),
        dots: points.iter().map(|point| dot(point, curves)).collect(),
        curves: curve_lines(points, curves),
        front: cloud.front(),
        interval,
    }
}

/// A value and its interval.
type Ranged = (f64, Option<(f64, f64)>);

fn axis(title: &str, points: &[Point], of: fn(&Point) -> Ranged) -> Axis {
    let values: Vec<f64> = points
        .iter()
        .map(of)
        .flat_map(|(value, range)| {
            let (low, high) = range.unwrap_or((value, value));
            [value, low, high]
        })
        .collect();
    Axis::log_with_zero(title, values.into_iter(), ZERO_BAND)
}

fn dot(point: &Point, curves: &Curves) -> Dot {
    let name = match &point.sweep {
        Some(sweep) => value_name(sweep),
        None => point.contender.label(),
    };
    Dot {
        at: (point.shadow_ms, point.wrong_px),
        x_range: point.shadow_ms_range,
        y_range: point.wrong_px_range,
        key: Key::of(curves.place(&point.contender)),
        name: shortened(&name, NAME_CHARS),
        on_front: point.dominated_by.is_none(),
    }
}

/// The name of a point on a curve that the key names.
fn value_name(
    SweepRecord {
        parameter, value, ..
    }: &SweepRecord,
) -> String {
    if parameter.chars().count() <= SHORT_PARAMETER {
        format!("{parameter} {value}")
    } else {
        value.to_string()
    }
}

/// A line through the points of each sweep, in the order of its values.
fn curve_lines(points: &[Point], curves: &Curves) -> Vec<CurveLine> {
    let mut lines = Vec::new();
    for (place, curve) in curves.all.iter().enumerate() {
        let mut on: Vec<(f64, usize)> = points
            .iter()
            .enumerate()
            .filter(|(_, point)| point.curve == *curve)
            .filter_map(|(index, point)| Some((point.sweep.as_ref()?.value, index)))
            .collect();
        on.sort_by(|a, b| a.0.total_cmp(&b.0));
        if !on.is_empty() {
            lines.push(CurveLine {
                key: Key::of(place),
                name: shortened(&curve.legend().label(), CURVE_NAME_CHARS),
                dots: on.into_iter().map(|(_, index)| index).collect(),
            });
        }
    }
    lines
}
