//! From the rows of runs to the values of a paper's tables.

use std::cmp::Reverse;

use super::published::Quantity;
use super::series::Series;
use super::sheet::{Column, Point, Sheet, Source};
use super::value::{Mask, Value};
use crate::record::{Status, Summary};
use crate::report::groups::Group;
use crate::report::load::Run;
use crate::variant::Variant;

/// Fills the groups' columns in, each after those of the paper. A group that has nothing of a table
/// gets no column in it.
pub(super) fn fill(sheets: &mut [Sheet], groups: &[Group<'_>]) {
    for sheet in sheets {
        for (index, group) in groups.iter().enumerate() {
            let column = column(sheet, group, Source::Measured(index));
            sheet.columns.extend(column);
        }
    }
}

/// The group's column from that one of its runs which has the most cells of the table, of equals the
/// one that started last, so that numbers that both have come from one run. Of the other runs, those
/// that share no cell with it complete the column.
fn column(sheet: &Sheet, group: &Group<'_>, source: Source) -> Option<Column> {
    let started = |run: &Run| run.info.started.parse::<jiff::Timestamp>().ok();
    let columns = group.runs.iter().map(|run| {
        let mut column = Column::empty(&group.label, source, sheet.spec, 0);
        column.runs.push(run.dir.display().to_string());
        for (index, series) in sheet.paper.series_of(sheet.spec).enumerate() {
            let (variant, values) = of_series(sheet.paper.quantity, series, &sheet.points, run);
            column.variants[index] = variant;
            column.values[index] = values;
        }
        (column, started(run))
    });
    let mut columns: Vec<_> = columns
        .filter(|(column, _)| column.all().count() > 0)
        .collect();
    columns.sort_by_key(|(column, started)| Reverse((column.all().count(), *started)));
    let mut columns = columns.into_iter().map(|(column, _)| column);
    let mut fullest = columns.next()?;
    columns.for_each(|other| fullest.join(&other));
    Some(fullest)
}

/// The values of the run's first variant that stands for the series and was measured at any point:
/// variants are never mixed within a series.
fn of_series(
    quantity: Quantity,
    series: &Series,
    points: &[Point],
    run: &Run,
) -> (Variant, Vec<Option<Value>>) {
    let listed = run.info.methods.iter();
    let listed = listed.map(|method| (&method.id, &method.variant));
    let rows = run.summaries.iter().map(|row| (&row.method, &row.variant));
    for whose in listed
        .chain(rows)
        .filter(|(method, variant)| series.is(method, variant))
    {
        let rows = run.summaries.iter();
        let rows = rows
            .filter(|row| (&row.method, &row.variant) == whose)
            .filter(|row| (row.width, row.height) == (run.info.width, run.info.height));
        let at = |point: &Point| {
            let mut here = rows.clone().filter(|row| point.at.holds(row));
            here.find_map(|row| value(quantity, row, run.info.frames))
        };
        let values: Vec<Option<Value>> = points.iter().map(at).collect();
        if values.iter().any(Option::is_some) {
            return (whose.1.clone(), values);
        }
    }
    (Variant::default(), vec![None; points.len()])
}

/// The value of a row; `None` where it was not measured or broke.
fn value(quantity: Quantity, row: &Summary, frames: u32) -> Option<Value> {
    if !matches!(row.status, Status::Ok | Status::Unverified) {
        return None;
    }
    let value = quantity
        .of(row)
        .filter(|value| value.is_finite() && *value > 0.0)?;
    let mask = match row.artifact_px {
        Some(1..) => Mask::Wrong,
        _ if row.frames < frames => Mask::CutShort,
        Some(0) if row.status == Status::Ok => Mask::Right,
        _ => Mask::Unverified,
    };
    Some(Value {
        // Runs from before these were recorded have nothing or zero here.
        record_ms: row.record_ms_median.filter(|record_ms| *record_ms > 0.0),
        draw_calls: row.draw_calls.filter(|draw_calls| *draw_calls > 0),
        ..Value::new(value, mask)
    })
}
