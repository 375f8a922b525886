//! A table with a paper's own numbers, which come with the program.

use std::collections::HashMap;

use anyhow::{Context as _, Result};

use super::published::{self, Publication, Spec};
use super::series::At;
use super::sheet::{Column, Point, Sheet, Source};
use super::value::{Mask, Value};
use crate::report::format::count;

/// Columns of numbers, of which a point may be made without a place.
const NUMBERS: [&str; 2] = ["triangles", "objects"];

/// A row of a file of published numbers, by the names of its columns.
type Record = HashMap<String, String>;

/// The tables of a paper with its devices in them.
///
/// # Errors
/// Where a published file does not fit the tables; the tests hold that none does.
pub(super) fn sheets(paper: &'static Publication) -> Result<Vec<Sheet>> {
    let read = |spec: &'static Spec| {
        let text = published::numbers(&spec.numbers)?;
        let damaged = || format!("results/published/{} is damaged", spec.numbers);
        sheet(paper, spec, text).with_context(damaged)
    };
    paper.tables.iter().map(read).collect()
}

pub(super) fn sheet(paper: &'static Publication, spec: &'static Spec, text: &str) -> Result<Sheet> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let rows: Vec<Record> = reader.deserialize().collect::<Result<_, _>>()?;
    let mut points: Vec<Point> = Vec::new();
    for row in &rows {
        let id = joined(row, &spec.point_columns)?;
        if points.iter().all(|point| point.id != id) {
            points.push(point(paper, spec, id)?);
        }
    }
    let mut columns: Vec<Column> = Vec::new();
    for row in &rows {
        let device = row.get("device").unwrap_or(&paper.device);
        let index = columns.iter().position(|known| known.device == *device);
        let index = index.unwrap_or_else(|| {
            columns.push(Column::empty(device, Source::Paper, spec, points.len()));
            columns.len() - 1
        });
        let id = joined(row, &spec.series_columns)?;
        let series = spec.series.iter().position(|known| *known == id);
        let series = series.with_context(|| format!("unknown: {id}"))?;
        let here = joined(row, &spec.point_columns)?;
        let value = field(row, paper.quantity.column())?;
        let value = value
            .parse()
            .with_context(|| format!("`{value}` is not a number"))?;
        if let Some(at) = points.iter().position(|point| point.id == here) {
            columns[index].values[series][at] = Some(Value::new(value, Mask::Published));
        }
    }
    Ok(Sheet {
        paper,
        spec,
        points,
        columns,
    })
}

fn field<'a>(row: &'a Record, column: &str) -> Result<&'a str> {
    let found = row.get(column);
    Ok(found.with_context(|| format!("there is no column `{column}`"))?)
}

fn joined(row: &Record, columns: &[String]) -> Result<String> {
    let fields = columns.iter().map(|column| field(row, column));
    Ok(fields.collect::<Result<Vec<_>>>()?.join("_"))
}

fn point(paper: &Publication, spec: &Spec, id: String) -> Result<Point> {
    if let Some(place) = paper.places.get(&id) {
        let short = if place.short.is_empty() {
            &place.name
        } else {
            &place.short
        };
        return Ok(Point {
            name: place.name.clone(),
            short: short.clone(),
            number: None,
            at: place.at.clone(),
            id,
        });
    }
    let is_number = matches!(spec.point_columns.as_slice(), [only] if NUMBERS.contains(&&**only));
    let number = id.parse::<u64>().ok().filter(|_| is_number);
    let number = number.with_context(|| format!("`{id}` is neither a number nor a known place"))?;
    let at = if spec.point_columns[0] == NUMBERS[0] {
        At {
            triangles: Some(number),
            ..spec.at.clone()
        }
    } else {
        At {
            objects: Some(number),
            ..spec.at.clone()
        }
    };
    Ok(Point {
        name: count(number),
        short: count(number),
        number: Some(number),
        at,
        id,
    })
}
