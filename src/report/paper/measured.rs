//! From the rows of runs to the values of a paper's tables.

use std::cmp::Reverse;

use super::published::Series;
use super::sheet::{Column, Mask, Point, Sheet, Value};
use crate::record::{Status, Summary};
use crate::report::groups::Group;
use crate::report::load::{Run, unique};

/// Fills the groups' columns in, each after those of the paper. A group that has nothing of a table
/// gets no column in it.
pub(super) fn fill(sheets: &mut [Sheet], groups: &[Group<'_>]) {
    for sheet in sheets {
        for (index, group) in groups.iter().enumerate() {
            let cells = of_group(sheet, group);
            if !cells.is_empty() {
                sheet.columns.push(Column {
                    device: group.label.clone(),
                    group: Some(index),
                    cells,
                });
            }
        }
    }
}

/// The values of that one of the group's runs which has the most cells of the table, of equals the
/// one that started last, so that numbers that both have come from one run. Of the other runs, those
/// complete them that share no cell, and no series in another variant.
fn of_group(sheet: &Sheet, group: &Group<'_>) -> Vec<Value> {
    let started = |run: &Run| run.info.started.parse::<jiff::Timestamp>().ok();
    let runs = group.runs.iter();
    let mut runs: Vec<_> = runs.map(|run| (of_run(sheet, run), started(run))).collect();
    runs.sort_by_key(|(values, started)| Reverse((values.len(), *started)));
    let mut all: Vec<Value> = Vec::new();
    for (values, _) in runs {
        let clashes = |own: &Value, other: &Value| {
            own.series == other.series && (own.point == other.point || own.variant != other.variant)
        };
        if !values
            .iter()
            .any(|other| all.iter().any(|own| clashes(own, other)))
        {
            all.extend(values);
        }
    }
    all
}

/// The values of each series in the run's first variant that stands for it and was measured at any point: variants
/// are never mixed within a series.
fn of_run(sheet: &Sheet, run: &Run) -> Vec<Value> {
    let listed = run.info.methods.iter();
    let listed = listed.map(|method| (&method.id, &method.variant));
    let rows = run.summaries.iter().map(|row| (&row.method, &row.variant));
    let methods = unique(listed.chain(rows));
    let of_series = |(index, series): (usize, &Series)| {
        let mut variants = methods
            .iter()
            .filter(|(method, variant)| series.is(method, variant));
        let found = variants.find_map(|whose| {
            let own = |row: &&Summary| (&row.method, &row.variant) == *whose;
            let rows: Vec<&Summary> = run.summaries.iter().filter(own).collect();
            let at = |(point, at): (usize, &Point)| {
                // A scene that pictures of another size were drawn of must be named.
                let is_meant = |row: &Summary| match at.at.scene.is_empty() {
                    true => (row.width, row.height) == (run.info.width, run.info.height),
                    false => run.is_of_own_size(row),
                };
                let mut here = rows.iter().filter(|row| at.at.holds(row) && is_meant(row));
                let value = here.find_map(|row| value(sheet, row, run))?;
                Some(Value {
                    series: index,
                    point,
                    ..value
                })
            };
            let values: Vec<Value> = sheet.points.iter().enumerate().filter_map(at).collect();
            (!values.is_empty()).then_some(values)
        });
        found.unwrap_or_default()
    };
    let series = sheet.paper.series_of(sheet.spec).enumerate();
    series.flat_map(of_series).collect()
}

/// The value of a row; `None` where it was not measured, or broke.
fn value(sheet: &Sheet, row: &Summary, run: &Run) -> Option<Value> {
    let is_measured = matches!(row.status, Status::Ok | Status::Unverified);
    let value = sheet.paper.quantity.of(row)?;
    let mask = match row.artifact_px {
        Some(1..) => Mask::Wrong,
        _ if row.frames < run.info.frames => Mask::CutShort,
        Some(0) if row.status == Status::Ok => Mask::Right,
        _ => Mask::Unverified,
    };
    (is_measured && value.is_finite() && value > 0.0).then(|| Value {
        value,
        mask,
        // Runs from before these were recorded have nothing or zero here.
        record_ms: row.record_ms_median.filter(|record_ms| *record_ms > 0.0),
        draw_calls: row.draw_calls.filter(|draw_calls| *draw_calls > 0),
        variant: row.variant.clone(),
        run: run.dir.display().to_string(),
        ..Value::default()
    })
}
