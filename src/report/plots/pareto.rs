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
    let times = |p: &Point| with_ends(p.shadow_ms, p.shadow_ms_range);
    let pixels = |p: &Point| with_ends(p.wrong_px, p.wrong_px_range);
    let x = Axis::log(x, &points.iter().flat_map(times).collect::<Vec<_>>());
    let y = Axis::log(y, &points.iter().flat_map(pixels).collect::<Vec<_>>());

    let mut lines: Vec<Line> = points.iter().flat_map(whiskers).collect();
    let dominated = |point: &Point| point.dominated_by.is_some();
    let samples = [
        (true, Style::line(FRONT, 2), "Pareto front"),
        (points.iter().any(dominated), FADED_DOT, "dominated"),
        (!lines.is_empty(), INTERVAL, interval),
    ];
    let samples = samples.into_iter().filter(|(is_there, ..)| *is_there);
    let mut legend: Vec<(Style, Contender)> = samples
        .map(|(_, style, name)| (style, Contender::new(name, "")))
        .collect();
    for (index, curve) in curves.all.iter().enumerate() {
        let on_curve = on_curve(points, curve);
        if !on_curve.is_empty() {
            let style = Style {
                width_px: 1,
                ..Style::of(index)
            };
            legend.push((style, curve.legend()));
            let points = on_curve.into_iter().map(|(_, point)| place(point));
            lines.push(Line {
                style: Style::line(style.color, 1),
                points: points.collect(),
            });
        }
    }
    let front = cloud.front().into_iter().map(|index| place(&points[index]));
    lines.push(Line {
        style: Style::line(FRONT, 2),
        points: steps(front, x.high, y.high),
    });
    let mut dots: Vec<Dot> = points.iter().map(|point| dot(point, curves)).collect();
    dots.sort_by_key(|dot| !dot.is_strong);
    Chart {
        x,
        y,
        lines,
        dots,
        legend,
        ..Chart::default()
    }
}

fn place(point: &Point) -> (f64, f64) {
    (point.shadow_ms, point.wrong_px)
}

fn with_ends(value: f64, range: Option<(f64, f64)>) -> [f64; 3] {
    let (low, high) = range.unwrap_or((value, value));
    [low, value, high]
}

/// A point's intervals as lines.
fn whiskers(point: &Point) -> impl Iterator<Item = Line> {
    let (x, y) = place(point);
    let across = point
        .shadow_ms_range
        .map(|(low, high)| [(low, y), (high, y)]);
    let along = point
        .wrong_px_range
        .map(|(low, high)| [(x, low), (x, high)]);
    [across, along].into_iter().flatten().map(|ends| Line {
        style: INTERVAL,
        points: ends.to_vec(),
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
