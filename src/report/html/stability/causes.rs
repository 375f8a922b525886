//! A section for each cause: what it is, how many pixels are wrong at each value, and pictures.

use anyhow::Result;
use maud::{Markup, html};

use super::cause_id;
use super::failures::{Album, figures};
use crate::record::stress::{Outcome, StressMethod, StressRow};
use crate::report::LegendEntry;
use crate::report::format::{count, short};
use crate::report::html::pictures::legend_list;
use crate::report::html::shell::Section;
use crate::report::stability::{self, Line, Matrix, StressRun};
use crate::report::table::{Cell, Column, DASH, Table};

/// The sections of all causes.
pub(super) fn section(
    run: &StressRun,
    matrix: &Matrix<'_>,
    legend: &[LegendEntry],
) -> Result<Section> {
    let album = Album::of(run, matrix);
    let causes = matrix
        .lines
        .iter()
        .map(|line| cause(run, matrix, line, &album));
    let causes: Vec<Markup> = causes.collect::<Result<_>>()?;
    let content = html! {
        p.note {
            "Tables have the artifact pixels at every value; the first failing one is framed, "
            "! is a failure that no limit declares, and grey numbers are tolerated. Each first failure is "
            "shown below: the ray-traced truth, the method's shadow mask, and the errors. Click a picture, "
            "or move the focus to it, to see it large."
        }
        @if !album.holds_all() {
            p.note {
                "The pictures of this run are too many for one page. Those that it does not hold are links "
                "into the directory of the run."
            }
        }
        @if !legend.is_empty() { div.error-key { (legend_list(legend)) } }
        @for cause in causes { (cause) }
    };
    Ok(Section::new("causes", "Causes", content))
}

fn cause(
    run: &StressRun,
    matrix: &Matrix<'_>,
    line: &Line<'_>,
    album: &Album<'_>,
) -> Result<Markup> {
    let mut failures = Vec::new();
    for (index, cell) in line.cells.iter().enumerate() {
        if let Some(failure) = cell.failure() {
            failures.push(figures(run, line, index, failure, album)?);
        }
    }
    let is_tried = line
        .cells
        .iter()
        .any(|cell| *cell != stability::Cell::Untried);
    Ok(html! {
        article.cause id=(cause_id(line)) {
            h3 { (line.cause.title) " " code.quiet { (line.cause.id) } }
            p.why { (line.cause.why) }
            @if is_tried { (values(run, matrix, line)) }
            @else { p.quiet { "Not tried: the run was interrupted before." } }
            @for figures in failures { (figures) }
        }
    })
}

/// Methods in rows and values in columns: what turns up reads from left to right. Methods with nothing
/// to show are a sentence below.
fn values(run: &StressRun, matrix: &Matrix<'_>, line: &Line<'_>) -> Markup {
    let corner = format!("Artifact px by {}", line.cause.number);
    let mut columns = vec![Column::heads(Cell::from(corner).class("stay"), "stay")];
    columns.extend(
        line.cause
            .values
            .iter()
            .map(|value| Column::number(short(*value))),
    );
    let label = format!("Artifact pixels: {}", line.cause.title);
    let mut table = Table::new(label, columns).class("values");
    let (mut clean, mut unavailable) = (Vec::new(), Vec::new());
    for (method, cell) in matrix.methods.iter().zip(&line.cells) {
        let rows = run.rows_of(line.cause, method);
        let is_clean = rows.iter().all(|row| row.artifact_px == 0);
        match cell {
            stability::Cell::Unavailable { .. } => unavailable.push(method.name()),
            stability::Cell::Right { unavailable: 0, .. } if is_clean => clean.push(method.name()),
            _ => table.push(row(line, method, cell, &rows)),
        }
    }
    html! {
        @if !table.groups.is_empty() { (table.html()) }
        (others("No artifact pixel at any value", &clean))
        (others("Unavailable", &unavailable))
    }
}

fn others(what: &str, names: &[String]) -> Markup {
    html! {
        @if !names.is_empty() {
            p.others {
                (what) ": "
                @for (index, name) in names.iter().enumerate() {
                    @if index > 0 { " · " }
                    code { (name) }
                }
            }
        }
    }
}

fn row(
    line: &Line<'_>,
    method: &StressMethod,
    cell: &stability::Cell<'_>,
    rows: &[&StressRow],
) -> Vec<Cell> {
    let name = Cell::code(&method.id);
    let variant = method.variant.as_str().replace(',', ", ");
    let name = if variant.is_empty() {
        name
    } else {
        name.small(variant)
    };
    let first = cell.failure().map(|failure| failure.first.value);
    let at = |value: &f64| {
        let row = rows.iter().find(|row| row.value == *value);
        row.map_or_else(Cell::default, |row| value_cell(row, first == Some(*value)))
    };
    [name]
        .into_iter()
        .chain(line.cause.values.iter().map(at))
        .collect()
}

fn value_cell(row: &StressRow, is_first: bool) -> Cell {
    let px = count(row.artifact_px);
    let framed = |class: &str| {
        if is_first {
            format!("{class} first")
        } else {
            class.to_owned()
        }
    };
    match row.outcome {
        Outcome::Unavailable => Cell::from(DASH).class("unavailable").tooltip(&row.reason),
        Outcome::Right if row.artifact_px == 0 => {
            Cell::drawn(html! { "·" span.sr { " right" } }).class("none")
        }
        Outcome::Right => Cell::from(px).class("none"),
        Outcome::Declared => Cell::from(px).class(framed("declared")),
        Outcome::Failed => Cell::from("broke!")
            .class("undeclared")
            .tooltip(&row.reason),
        Outcome::Undeclared => Cell::from(px + "!").class(framed("undeclared")),
    }
}
