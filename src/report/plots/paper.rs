//! Figures 5 to 8 of Milet et al. 2014, each the picture of a table: published and measured devices
//! together.
//!
//! A line's colour says what is compared, its marker which device; lines of the paper are dashed and
//! thin, its bars hollow.

use super::axis::Axis;
use super::bars::{Bar, BarChart, Group};
use super::canvas::{self, INK};
use super::legend::Key;
use super::lines::{Line, LineChart};
use super::{Chart, Figure};
use crate::report::load::Contender;
use crate::report::paper::Paper;
use crate::report::paper::sheet::{Column, Sheet};
use crate::report::paper::spec::{Place, Point};

/// Dashes of the first published device and of the others.
const DASHES_PX: [i32; 2] = [7, 3];

/// A figure for each table that was measured.
pub(super) fn figures(paper: &Paper) -> Vec<Figure> {
    paper.sheets.iter().map(figure).collect()
}

fn figure(sheet: &Sheet) -> Figure {
    let chart = if sheet.spec.series_are_rows {
        Chart::Bars(bars(sheet))
    } else {
        Chart::Lines(lines(sheet))
    };
    Figure {
        name: sheet.spec.figure_name(),
        title: format!("Figure {}: {}", sheet.spec.figure, sheet.spec.title),
        chart,
    }
}

fn lines(sheet: &Sheet) -> LineChart {
    let mut lines = Vec::new();
    for (device, column) in sheet.columns.iter().enumerate() {
        for (series, what) in sheet.spec.series.iter().enumerate() {
            let points: Vec<(f64, f64)> = sheet
                .points
                .iter()
                .enumerate()
                .filter_map(|(at, point)| {
                    Some((point.number()? as f64, column.cell(series, at)?.fps))
                })
                .collect();
            if !points.is_empty() {
                lines.push(Line {
                    key: Key {
                        color: canvas::color(series),
                        ..device_key(device, column)
                    },
                    contender: contender(what.name, &column.device),
                    points,
                });
            }
        }
    }
    // Measured lines lie over the published ones.
    lines.sort_by_key(|line| line.key.dash_px.is_none());
    let points = || lines.iter().flat_map(|line| line.points.iter().copied());
    let x: Vec<f64> = points().map(|point| point.0).collect();
    let y: Vec<f64> = points().map(|point| point.1).collect();
    LineChart {
        x: Axis::fit(sheet.spec.points, x.into_iter()),
        y: Axis::fit("Frames per second", y.into_iter()),
        keys: keys(sheet),
        lines,
    }
}

/// The colours, then the markers.
fn keys(sheet: &Sheet) -> Vec<(Key, Contender)> {
    let series = sheet.spec.series.iter().enumerate().map(|(index, what)| {
        let key = Key {
            marker: None,
            ..Key::of(index)
        };
        (key, contender(what.name, ""))
    });
    let devices = sheet.columns.iter().enumerate().map(|(index, column)| {
        let who = if column.is_published() {
            "published"
        } else {
            "measured"
        };
        (device_key(index, column), contender(&column.device, who))
    });
    series.chain(devices).collect()
}

fn device_key(index: usize, column: &Column) -> Key {
    let dash_px = DASHES_PX[index.min(DASHES_PX.len() - 1)];
    Key {
        color: INK,
        marker: Some(index),
        dash_px: column.is_published().then_some(dash_px),
    }
}

fn contender(method: &str, variant: &str) -> Contender {
    Contender {
        method: method.to_owned(),
        variant: variant.to_owned(),
    }
}

fn bars(sheet: &Sheet) -> BarChart {
    let series = 0..sheet.spec.series.len();
    let mut groups = Vec::new();
    for (at, point) in sheet.points.iter().enumerate() {
        for column in &sheet.columns {
            let bar = |series| {
                let value = column.cell(series, at)?.fps;
                Some(Bar {
                    value,
                    whisker: None,
                })
            };
            groups.push(Group {
                name: format!("{} {}", scene(*point), column.device),
                hollow: column.is_published(),
                bars: series.clone().map(bar).collect(),
            });
        }
    }
    groups.retain(|group| group.bars.iter().any(Option::is_some));
    let all = groups.iter().flat_map(|group| group.bars.iter().flatten());
    let fps: Vec<f64> = all.map(|bar| bar.value).collect();
    BarChart {
        y: Axis::fit("Frames per second", fps.into_iter()),
        contenders: sheet
            .spec
            .series
            .iter()
            .map(|what| contender(what.name, ""))
            .collect(),
        groups,
    }
}

/// A scene's name, short enough to stand under bars.
fn scene(point: Point) -> String {
    match point {
        Point::Scene(Place::Spheres4M) => "4M spheres".to_owned(),
        Point::Scene(Place::Sponza) => "Sponza".to_owned(),
        other => other.name(),
    }
}
