//! A table with a paper's own numbers, which come with the program.

use std::collections::HashMap;

use anyhow::{Context as _, Result, bail};

use super::published::{self, Place, Publication, Spec};
use super::sheet::{Column, Point, Sheet, Value};
use crate::report::format::count;

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
    let mut sheet = Sheet {
        paper,
        spec,
        points: Vec::new(),
        columns: Vec::new(),
    };
    for row in csv::Reader::from_reader(text.as_bytes()).deserialize() {
        add(&mut sheet, &row?)?;
    }
    for id in &spec.also {
        sheet.points.push(point(paper, spec, id.clone())?);
    }
    Ok(sheet)
}

fn add(sheet: &mut Sheet, row: &Record) -> Result<()> {
    let (paper, spec) = (sheet.paper, sheet.spec);
    let id = joined(row, &spec.point_columns)?;
    let known = sheet.points.iter().position(|point| point.id == id);
    if known.is_none() {
        sheet.points.push(point(paper, spec, id)?);
    }
    let id = joined(row, &spec.series_columns)?;
    let series = spec.series.iter().position(|known| *known == id);
    let text = field(row, paper.quantity.column())?;
    let number = text.parse::<f64>();
    let value = Value {
        series: series.with_context(|| format!("unknown: {id}"))?,
        point: known.unwrap_or(sheet.points.len() - 1),
        value: number.with_context(|| format!("`{text}` is not a number"))?,
        ..Value::default()
    };
    let device = row.get("device").unwrap_or(&paper.device);
    match sheet.columns.iter_mut().find(|c| c.device == *device) {
        Some(column) => column.cells.push(value),
        None => sheet.columns.push(Column {
            device: device.clone(),
            group: None,
            cells: vec![value],
        }),
    }
    Ok(())
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
    if let Some(Place { name, short, at }) = paper.places.get(&id) {
        return Ok(Point {
            name: name.clone(),
            short: short.clone(),
            number: None,
            at: at.clone(),
            id,
        });
    }
    let mut at = spec.at.clone();
    let counted = match spec.point_columns.as_slice() {
        [only] if only == "triangles" => Some(&mut at.triangles),
        [only] if only == "objects" => Some(&mut at.objects),
        _ => None,
    };
    let (Ok(number), Some(counted)) = (id.parse(), counted) else {
        bail!("`{id}` is neither a number nor a known place");
    };
    *counted = Some(number);
    Ok(Point {
        name: count(number),
        short: String::new(),
        number: Some(number),
        at,
        id,
    })
}
