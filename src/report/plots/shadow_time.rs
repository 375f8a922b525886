//! Shadow time of the contenders: in every scene, against the number of casting triangles, and along the flight.

use std::collections::BTreeMap;

use super::Figure;
use super::axis::Axis;
use super::bars::Group;
use super::canvas::Style;
use super::chart::{AxisOf, Chart, Line};
use super::chosen::Chosen;
use crate::file_name::file_name;
use crate::record::Summary;
use crate::record::growth::{self, Growth};
use crate::record::statistics::median;
use crate::report::curve::Contender;
use crate::report::load::{Run, unique};

/// Shadow time of every method in every scene, side by side; `None` where nothing was measured.
pub(super) fn by_scene(run: &Run) -> Option<Figure> {
    let Chosen { keys, remark } = Chosen::of(run);
    let group = |scene: &str| {
        let rows = run.rows(scene);
        let bar = |(_, contender): &_| {
            let row = rows.iter().find(|row| run.contender(row) == *contender)?;
            row.shadow_ms_median.zip(row.shadow_ms_p95)
        };
        Group {
            name: scene.to_owned(),
            bars: keys.iter().map(bar).collect(),
            ..Group::default()
        }
    };
    let mut groups: Vec<Group> = run.scenes().into_iter().map(group).collect();
    groups.retain(|group| group.bars.iter().any(Option::is_some));
    (!groups.is_empty()).then(|| Figure {
        name: "shadow_time_by_scene".to_owned(),
        title: format!("Shadow time by scene{remark}"),
        chart: Chart::of_bars(("Shadow time, median and p95, ms", Axis::fit), groups, keys),
    })
}

/// Over scenes that differ in nothing else: a figure per family of scenes that has at least two points.
pub(super) fn by_growth(run: &Run) -> Vec<Figure> {
    let of_growth = |growth: &Growth| {
        let families = unique(run.scenes().iter().filter_map(|s| growth.family(s)));
        let figure = |family: &String| figure_of_family(run, growth, family);
        let mut figures: Vec<Figure> = families.iter().filter_map(figure).collect();
        if let [only] = figures.as_mut_slice() {
            only.name = format!("shadow_time_by_{}", growth.name);
        }
        figures
    };
    growth::ALL.iter().flat_map(of_growth).collect()
}

fn figure_of_family(run: &Run, growth: &Growth, family_name: &str) -> Option<Figure> {
    let Chosen { keys, remark } = Chosen::of(run);
    let points = |contender: &Contender| {
        let rows = run.summaries.iter().filter(|row| {
            growth.family(&row.scene).as_deref() == Some(family_name)
                && run.contender(row) == *contender
        });
        let mut points: Vec<(f64, f64)> = rows
            .filter_map(|row| Some((growth.amount(row)? as f64, row.shadow_ms_median?)))
            .filter(|(amount, shadow_ms)| *amount > 0.0 && *shadow_ms > 0.0)
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    };
    let x = (growth.title, Axis::log as _);
    let y = ("Shadow time, median, ms", Axis::log as _);
    let chart = lines(x, y, keys, points);
    let mut all = chart.lines.iter().flat_map(|line| &line.points);
    let first = all.next()?;
    all.any(|point| point.0 != first.0).then(|| Figure {
        name: format!("shadow_time_by_{}_{}", growth.name, file_name(family_name)),
        title: format!(
            "Shadow time by {}, {family_name}{remark}",
            growth.title.to_lowercase()
        ),
        chart,
    })
}

/// Where a method pays, and whether it pays evenly: a figure per scene in which at least two frames were
/// measured.
pub(super) fn along_flights(run: &Run) -> Vec<Figure> {
    let figure = |scene: &str| {
        let Chosen { keys, remark } = Chosen::of(run);
        let rows = run.rows(scene);
        let points = |contender: &Contender| {
            let row = rows.iter().find(|row| run.contender(row) == *contender);
            let points = row.map_or_else(Vec::new, |row| along_flight(run, row));
            if points.len() < 2 { Vec::new() } else { points }
        };
        let x = ("Time along the flight, s", Axis::exact as _);
        let chart = lines(x, ("Shadow time, ms", Axis::fit), keys, points);
        (!chart.lines.is_empty()).then(|| Figure {
            name: format!("flight_{}", file_name(scene)),
            title: format!(
                "Shadow time along the flight, {}{remark}",
                run.scene_title(scene)
            ),
            chart,
        })
    };
    run.scenes().into_iter().filter_map(figure).collect()
}

/// Time on the flight and shadow time, a point per frame; the median where a frame was measured more
/// than once.
fn along_flight(run: &Run, row: &Summary) -> Vec<(f64, f64)> {
    let mut frames: BTreeMap<u32, (f64, Vec<f64>)> = BTreeMap::new();
    for sample in run.samples_of(row) {
        let frame = frames.entry(sample.frame).or_default();
        frame.0 = sample.time_s;
        frame.1.push(sample.shadow_ms);
    }
    let frames = frames.into_values();
    frames
        .filter_map(|(time_s, all)| Some((time_s, median(&all)?)))
        .collect()
}

/// A line for each contender that has points; in the legend from top to bottom as they end.
fn lines(
    x: AxisOf<'_>,
    y: AxisOf<'_>,
    keys: Vec<(Style, Contender)>,
    points: impl Fn(&Contender) -> Vec<(f64, f64)>,
) -> Chart {
    let (mut lines, mut ends) = (Vec::new(), Vec::new());
    for key in keys {
        let points = points(&key.1);
        if let Some((_, end)) = points.last() {
            ends.push((*end, key.clone()));
            let style = key.0;
            lines.push(Line { style, points });
        }
    }
    ends.sort_by(|a, b| b.0.total_cmp(&a.0));
    let legend = ends.into_iter().map(|(_, key)| key).collect();
    Chart::of_lines(x, y, lines, legend)
}
