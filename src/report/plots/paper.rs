//! The figures of papers, each the picture of a table: published and measured devices together.
//!
//! A line's colour says what is compared, its marker which device; lines of the paper are dashed and
//! thin, its bars hollow.

use super::axis::Axis;
use super::bars::{Bar, BarChart, Group};
use super::canvas::{self, INK};
use super::legend::Key;
use super::lines::{Line, LineChart};
use super::{Chart, Figure};
use crate::report::curve::Contender;
use crate::report::paper::Paper;
use crate::report::paper::sheet::{Column, Sheet};

/// Dashes of the first published device and of the others.
const DASHES_PX: [i32; 2] = [7, 3];

/// A figure for each table that was measured.
pub(super) fn figures(paper: &Paper) -> Vec<Figure> {
    paper.sheets.iter().map(figure).collect()
}

fn names(sheet: &Sheet) -> impl Iterator<Item = &str> {
    sheet
        .paper
        .series_of(sheet.spec)
        .map(|series| series.name.as_str())
}

fn figure(sheet: &Sheet) -> Figure {
    // A legend of lines shows its dashes; one of bars has nothing hollow to show.
    let (chart, key) = if sheet.spec.series_are_rows {
        (Chart::Bars(bars(sheet)), "; hollow: published")
    } else {
        (Chart::Lines(lines(sheet)), "")
    };
    let (number, what) = (sheet.spec.figure, &sheet.spec.title);
    Figure {
        name: sheet.paper.figure_name(sheet.spec),
        title: format!("Figure {number}: {what}{key}"),
        chart,
    }
}

fn lines(sheet: &Sheet) -> LineChart {
    let mut lines = Vec::new();
    for (device, column) in sheet.columns.iter().enumerate() {
        for (series, name) in names(sheet).enumerate() {
            let points: Vec<(f64, f64)> = sheet
                .points
                .iter()
                .enumerate()
                .filter_map(|(at, point)| {
                    Some((point.number? as f64, column.value(series, at)?.value))
                })
                .collect();
            if !points.is_empty() {
                lines.push(Line {
                    key: Key {
                        color: canvas::color(series),
                        ..device_key(device, column)
                    },
                    contender: Contender::new(name, &column.device),
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
        x: Axis::fit(&sheet.spec.points, x.into_iter()),
        y: Axis::fit(sheet.paper.quantity.title(), y.into_iter()),
        keys: keys(sheet),
        lines,
    }
}

/// The colours, then the markers.
fn keys(sheet: &Sheet) -> Vec<(Key, Contender)> {
    let series = names(sheet).enumerate().map(|(index, name)| {
        let key = Key {
            marker: None,
            ..Key::of(index)
        };
        (key, Contender::new(name, ""))
    });
    let devices = sheet.columns.iter().enumerate().map(|(index, column)| {
        let who = if column.is_published() {
            "published"
        } else {
            "measured"
        };
        (
            device_key(index, column),
            Contender::new(&column.device, who),
        )
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

/// The bars of each device, scene by scene.
fn bars(sheet: &Sheet) -> BarChart {
    let (mut groups, mut bands) = (Vec::new(), Vec::new());
    for (at, point) in sheet.points.iter().enumerate() {
        let devices = sheet.columns.iter().map(|column| group(sheet, column, at));
        let measured = devices.filter(|group| group.bars.iter().any(Option::is_some));
        let before = groups.len();
        groups.extend(measured);
        bands.push((point.name.clone(), groups.len() - before));
    }
    let all = groups.iter().flat_map(|group| group.bars.iter().flatten());
    let fps: Vec<f64> = all.map(|bar| bar.value).collect();
    let names = names(sheet);
    BarChart {
        y: Axis::fit(sheet.paper.quantity.title(), fps.into_iter()),
        keys: names
            .enumerate()
            .map(|(index, name)| (Key::of(index), Contender::new(name, "")))
            .collect(),
        groups,
        bands,
    }
}

fn group(sheet: &Sheet, column: &Column, point: usize) -> Group {
    let bar = |series| {
        let cell = column.value(series, point)?;
        Some(Bar {
            value: cell.value,
            whisker: None,
        })
    };
    Group {
        name: column.device.clone(),
        hollow: column.is_published(),
        bars: (0..sheet.spec.series.len()).map(bar).collect(),
    }
}
