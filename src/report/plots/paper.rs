//! The figures of papers, each the picture of a table: published and measured devices together.
//!
//! A line's colour says what is compared, its marker which device; lines of the paper are dashed and
//! thin, its bars hollow.

use super::Figure;
use super::axis::Axis;
use super::bars::Group;
use super::canvas::{INK, Style};
use super::chart::{Chart, Line};
use crate::report::curve::Contender;
use crate::report::paper::Paper;
use crate::report::paper::sheet::{Column, Point, Sheet};

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
    let (chart, key) = if sheet.points.iter().all(|point| point.number.is_none()) {
        (bars(sheet), "; hollow: published")
    } else {
        (lines(sheet), "")
    };
    let (number, what) = (sheet.spec.figure, &sheet.spec.title);
    Figure {
        name: sheet.paper.figure_name(sheet.spec),
        title: format!("Figure {number}: {what}{key}"),
        chart,
    }
}

fn lines(sheet: &Sheet) -> Chart {
    let mut lines = Vec::new();
    for (device, column) in sheet.columns.iter().enumerate() {
        for series in 0..names(sheet).count() {
            let point = |(at, point): (usize, &Point)| {
                Some((point.number? as f64, column.value(series, at)?.value))
            };
            let points: Vec<_> = sheet.points.iter().enumerate().filter_map(point).collect();
            let color = Style::of(series).color;
            let style = Style {
                color,
                ..device_style(device, column)
            };
            if !points.is_empty() {
                lines.push(Line { style, points });
            }
        }
    }
    // Measured lines lie over the published ones.
    lines.sort_by_key(|line| line.style.dash_px == 0);
    // The colours, then the markers.
    let series = names(sheet).enumerate().map(|(index, name)| {
        let style = Style::line(Style::of(index).color, 2);
        (style, Contender::new(name, ""))
    });
    let devices = sheet.columns.iter().enumerate().map(|(index, column)| {
        let who = if column.is_published() {
            "published"
        } else {
            "measured"
        };
        let name = Contender::new(&column.device, who);
        (device_style(index, column), name)
    });
    let legend = series.chain(devices).collect();
    let y = (sheet.paper.quantity.title(), Axis::fit as _);
    Chart::of_lines((&sheet.spec.points, Axis::fit), y, lines, legend)
}

fn device_style(index: usize, column: &Column) -> Style {
    let style = Style {
        marker: Some(index),
        ..Style::line(INK, 2)
    };
    if column.is_published() {
        style.dashed(DASHES_PX[index.min(DASHES_PX.len() - 1)])
    } else {
        style
    }
}

/// The bars of each device, scene by scene.
fn bars(sheet: &Sheet) -> Chart {
    let mut groups = Vec::new();
    for (at, point) in sheet.points.iter().enumerate() {
        groups.extend(sheet.columns.iter().map(|column| {
            let value = |series| column.value(series, at).map(|cell| cell.value);
            let bars = (0..sheet.spec.series.len()).map(value);
            Group {
                name: column.device.clone(),
                band: point.name.clone(),
                is_hollow: column.is_published(),
                bars: bars.map(|value| value.zip(value)).collect(),
            }
        }));
    }
    groups.retain(|group| group.bars.iter().any(Option::is_some));
    let entry = |(index, name)| (Style::of(index), Contender::new(name, ""));
    let legend = names(sheet).enumerate().map(entry).collect();
    let y = (sheet.paper.quantity.title(), Axis::fit as _);
    Chart::of_bars(y, groups, legend)
}
