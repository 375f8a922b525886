//! From the rows of runs to the cells of the paper's tables.

use crate::variant::Variant;
use std::cmp::Reverse;

use super::sheet::{Cell, Column, Mask, Sheet, Source};
use super::spec::{Point, Series, Spec};
use crate::record::{Status, Summary};
use crate::report::groups::Group;
use crate::report::load::Run;

/// Fills the groups' columns in, each after those of the paper. A group that has nothing of a table
/// gets no column in it.
pub(super) fn fill(sheets: &mut [Sheet], groups: &[Group<'_>]) {
    for sheet in sheets {
        for (index, group) in groups.iter().enumerate() {
            let source = Source::Measured(index);
            let column = column(sheet.spec, &sheet.points, group, source);
            sheet.columns.extend(column);
        }
    }
}

/// The group's column from that one of its runs which has the most cells of the table, of equals the
/// one that started last, so that numbers that both have come from one run. Of the other runs, those
/// that share no cell with it complete the column.
fn column(spec: &Spec, points: &[Point], group: &Group<'_>, source: Source) -> Option<Column> {
    let whose = (group.label.as_str(), source);
    let started = |run: &Run| run.info.started.parse::<jiff::Timestamp>().ok();
    let mut columns: Vec<_> = group
        .runs
        .iter()
        .map(|run| (of_run(spec, points, whose, run), started(run)))
        .filter(|(column, _)| column.count() > 0)
        .collect();
    columns.sort_by_key(|(column, started)| Reverse((column.count(), *started)));
    let mut columns = columns.into_iter().map(|(column, _)| column);
    let mut fullest = columns.next()?;
    for other in columns {
        fullest.join(&other);
    }
    Some(fullest)
}

fn of_run(spec: &Spec, points: &[Point], (device, source): (&str, Source), run: &Run) -> Column {
    let mut cells = Vec::new();
    let mut variants = Vec::new();
    for series in spec.series {
        let (variant, row) = of_series(series, points, run);
        variants.push(variant);
        cells.push(row);
    }
    Column {
        device: device.to_owned(),
        source,
        cells,
        variants,
        runs: vec![run.dir.display().to_string()],
    }
}

/// The cells of the run's first variant that stands for the series and was measured at any point:
/// variants are never mixed within a series.
fn of_series(series: &Series, points: &[Point], run: &Run) -> (Variant, Vec<Option<Cell>>) {
    let listed = run.info.methods.iter();
    let listed = listed.map(|method| (method.id.as_str(), &method.variant));
    let rows = run.summaries.iter();
    let rows = rows.map(|row| (row.method.as_str(), &row.variant));
    for (method, variant) in listed.chain(rows) {
        if !series.is(method, variant) {
            continue;
        }
        let at = |point: &Point| {
            run.summaries
                .iter()
                .filter(|row| (row.method.as_str(), &row.variant) == (method, variant))
                .filter(|row| (row.width, row.height) == (run.info.width, run.info.height))
                .filter(|row| point.holds(row))
                .find_map(|row| cell(row, run.info.frames))
        };
        let cells: Vec<Option<Cell>> = points.iter().map(at).collect();
        if cells.iter().any(Option::is_some) {
            return (variant.clone(), cells);
        }
    }
    (Variant::default(), vec![None; points.len()])
}

/// The row as a cell; `None` where it was not measured or broke.
fn cell(row: &Summary, frames: u32) -> Option<Cell> {
    if !matches!(row.status, Status::Ok | Status::Unverified) {
        return None;
    }
    let fps = row.fps.filter(|fps| fps.is_finite() && *fps > 0.0)?;
    let mask = match row.artifact_px {
        Some(1..) => Mask::Wrong,
        _ if row.frames < frames => Mask::CutShort,
        Some(0) if row.status == Status::Ok => Mask::Right,
        _ => Mask::Unverified,
    };
    Some(Cell {
        fps,
        mask,
        // Runs from before these were recorded have nothing or zero here.
        record_ms: row.record_ms_median.filter(|record_ms| *record_ms > 0.0),
        draw_calls: row.draw_calls.filter(|draw_calls| *draw_calls > 0),
        run: 0,
    })
}
