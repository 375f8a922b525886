//! Shadow time against wrong pixels: a chart for each scene, and one over all of them.

use super::Figure;
use super::axis::Axis;
use super::canvas::{FADED, FRONT, Style, WHISKER, shortened};
use super::chart::{Chart, Dot, Line};
use crate::file_name::file_name;
use crate::report::curve::{Contender, Curve, Curves};
use crate::report::load::Run;
use crate::report::pareto::{Cloud, Point};

/// How the name of each of these plots begins.
pub(in crate::report) const PREFIX: &str = "pareto_";
/// What stands for the scene in the name of the plot over all of them.
const ALL: &str = "all";
/// Enough for a method with a parameter; longer ones lose their middle.
const NAME_CHARS: usize = 46;
/// A swept parameter with a name this short stands before its value: `pcf 3`, but `1024`.
const SHORT_PARAMETER: usize = 4;
const INTERVAL: Style = Style {
    cap_px: 3,
    ..Style::line(WHISKER, 1)
};
const FADED_DOT: Style = Style {
    marker: Some(0),
    ..Style::line(FADED, 0)
};

pub(super) fn figures(run: &Run, clouds: &[Cloud]) -> Vec<Figure> {
    let curves = Curves::of(run);
    let figure = |cloud: &Cloud| {
        let (name, place) = match &cloud.scene {
            // Not the name of the plot over all scenes.
            Some(scene) if scene == ALL => (format!("{ALL}~scene"), run.scene_title(scene)),
            Some(scene) => (file_name(scene), run.scene_title(scene)),
            None => (ALL.to_owned(), "over all scenes"),
        };
        Figure {
            name: format!("{PREFIX}{name}"),
            title: format!("Accuracy against speed, {place}"),
            chart: chart(cloud, &curves),
        }
    };
    clouds.iter().map(figure).collect()
}

fn chart(cloud: &Cloud, curves: &Curves) -> Chart {
    let (x, y, interval) = if cloud.scene.is_none() {
        (
            "Shadow time, geometric mean of the scenes' medians, ms",
            "Wrong pixels per verified frame, mean of the scenes",
            "least to greatest of the scenes",
        )
    } else {
        (
            "Shadow time, median, ms",
            "Wrong pixels per verified frame, mean",
            "5th to 95th percentile of the frames",
        )
    };
    let points = &cloud.points;
    let has_interval = |p: &Point| p.shadow_ms_range.or(p.wrong_px_range).is_some();
    let samples = [
        (true, Style::line(FRONT, 2), ["Pareto front", ""]),
        (
            points.iter().any(|p| p.dominated_by.is_some()),
            FADED_DOT,
            ["dominated", ""],
        ),
        (
            points.iter().any(has_interval),
            INTERVAL,
            ["interval", interval],
        ),
    ];
    let samples = samples.into_iter().filter(|(is_there, ..)| *is_there);
    let legend = samples.map(|(_, style, [name, what])| (style, Contender::new(name, what)));
    let whiskers = points.iter().flat_map(whiskers).collect();
    let (x, y) = ((x, Axis::log as _), (y, Axis::log as _));
    let mut chart = Chart::of_lines(x, y, whiskers, legend.collect());
    for (index, curve) in curves.all.iter().enumerate() {
        let on_curve = on_curve(points, curve);
        if !on_curve.is_empty() {
            let style = Style::of(index);
            let width_px = 1;
            chart
                .legend
                .push((Style { width_px, ..style }, curve.legend()));
            chart.lines.push(Line {
                style: Style::line(style.color, width_px),
                points: on_curve
                    .into_iter()
                    .map(|(_, point)| place(point))
                    .collect(),
            });
        }
    }
    let front = cloud.front().into_iter().map(|index| place(&points[index]));
    chart.lines.push(Line {
        style: Style::line(FRONT, 2),
        points: steps(front, chart.x.high, chart.y.high),
    });
    chart.dots = points.iter().map(|point| dot(point, curves)).collect();
    chart.dots.sort_by_key(|dot| !dot.is_strong);
    chart
}

fn place(point: &Point) -> (f64, f64) {
    (point.shadow_ms, point.wrong_px)
}

/// A point's intervals as lines through it; where there is none, its marker hides the line.
fn whiskers(point: &Point) -> [Line; 2] {
    let (x, y) = place(point);
    let ends = |value, range: Option<(f64, f64)>| {
        let (low, high) = range.unwrap_or((value, value));
        [low, value, high]
    };
    let across = ends(x, point.shadow_ms_range).map(|x| (x, y));
    let along = ends(y, point.wrong_px_range).map(|y| (x, y));
    [across, along].map(|points| Line {
        style: INTERVAL,
        points: points.to_vec(),
    })
}

/// The front as steps: at each time, the fewest wrong pixels that one can have by then.
fn steps(front: impl Iterator<Item = (f64, f64)>, right: f64, mut height: f64) -> Vec<(f64, f64)> {
    let mut path = Vec::new();
    for (x, y) in front {
        path.extend([(x, height), (x, y)]);
        height = y;
    }
    path.push((right, height));
    path
}

/// The points of a cloud that are on a swept curve, with their values in ascending order.
pub(super) fn on_curve<'a>(points: &'a [Point], curve: &Curve) -> Vec<(f64, &'a Point)> {
    let on_curve = points.iter().filter(|point| point.curve == *curve);
    let valued = on_curve.filter_map(|point| Some((point.sweep.as_ref()?.value, point)));
    let mut valued: Vec<(f64, &Point)> = valued.collect();
    valued.sort_by(|a, b| a.0.total_cmp(&b.0));
    valued
}

fn dot(point: &Point, curves: &Curves) -> Dot {
    let name = match &point.sweep {
        // The legend names the curve.
        Some(sweep) if sweep.parameter.chars().count() <= SHORT_PARAMETER => {
            format!("{} {}", sweep.parameter, sweep.value)
        }
        Some(sweep) => sweep.value.to_string(),
        None => point.contender.label(),
    };
    let style = Style::of(curves.place(&point.contender));
    let is_strong = point.dominated_by.is_none();
    let color = if is_strong { style.color } else { FADED };
    Dot {
        at: place(point),
        style: Style { color, ..style },
        name: shortened(&name, NAME_CHARS),
        is_strong,
    }
}
