//! A section for each cause: what it is, how many pixels are wrong at each value, and pictures.

use anyhow::Result;
use maud::{Markup, html};

use super::failure_id;
use super::failures::{album, figure};
use crate::record::stress::{Outcome, StressMethod, StressRow};
use crate::report::LegendEntry;
use crate::report::format::{count, short};
use crate::report::html::pictures::{Album, legend_list};
use crate::report::html::shell::{Section, note};
use crate::report::stability::{self, Line, Matrix, StressRun};
use crate::report::table::{Cell, Column, DASH, Table};

pub(super) fn section(
    run: &StressRun,
    matrix: &Matrix<'_>,
    legend: &[LegendEntry],
) -> Result<Section> {
    let album = album(run, matrix)?;
    let content = html! {
        (note(include_str!("../notes/causes.html")))
        @if !album.is_whole() { (note(include_str!("../notes/too_many_failures.html"))) }
        @if !legend.is_empty() { div.error-key { (legend_list(legend)) } }
        @for line in &matrix.lines { (cause(run, line, &album)) }
    };
    Ok(Section::new("causes", "Causes", content))
}

fn cause(run: &StressRun, line: &Line<'_>, album: &Album) -> Markup {
    let mut cells = line.cells.iter();
    let is_tried = cells.any(|cell| *cell != stability::Cell::Untried);
    html! {
        article.cause id={ "cause-" (line.cause.id) } {
            h3 { (line.cause.title) " " code.quiet { (line.cause.id) } }
            p.why { (line.cause.why) }
            @if is_tried { (values(run, line)) }
            @else { p.quiet { "Not tried: the run was interrupted before." } }
            @for (index, cell) in line.cells.iter().enumerate() {
                @if let Some(failure) = cell.failure() {
                    div id=(failure_id(line, index)) {
                        @for row in failure.shown() { (figure(run, line, row, album)) }
                    }
                }
            }
        }
    }
}

/// Methods in rows and values in columns: what turns up reads from left to right. Methods with nothing
/// to show are a sentence below.
fn values(run: &StressRun, line: &Line<'_>) -> Markup {
    let (mut shown, mut clean, mut unavailable) = (Vec::new(), Vec::new(), Vec::new());
    for (method, cell) in run.info.methods.iter().zip(&line.cells) {
        let rows = run.rows_of(line.cause, method);
        let is_clean = rows.iter().all(|row| row.artifact_px == 0);
        match cell {
            stability::Cell::Unavailable { .. } => unavailable.push(method.name()),
            stability::Cell::Right { unavailable: 0, .. } if is_clean => clean.push(method.name()),
            _ => shown.push((method, cell, rows)),
        }
    }
    let corner = Cell::from(format!("Artifact px by {}", line.cause.number));
    let method = Column::heads(corner.class("stay"), "stay");
    let label = format!("Artifact pixels: {}", line.cause.title);
    let mut table = Table::of(label, &shown)
        .class("values")
        .column(method, |(method, ..)| name(method));
    for &value in &line.cause.values {
        table = table.number(short(value), |(_, cell, rows)| {
            let row = rows.iter().find(|row| row.value == value);
            row.map_or_else(Cell::default, |row| value_cell(row, cell))
        });
    }
    html! {
        @if !shown.is_empty() { (table.html()) }
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

fn name(method: &StressMethod) -> Cell {
    let name = Cell::code(&method.id);
    match method.variant.as_str() {
        "" => name,
        variant => name.small(variant.replace(',', ", ")),
    }
}

fn value_cell(row: &StressRow, cell: &stability::Cell<'_>) -> Cell {
    let px = count(row.artifact_px);
    let is_first = cell.failure().is_some_and(|f| f.first.value == row.value);
    let framed = if is_first { " first" } else { "" };
    match row.outcome {
        Outcome::Unavailable => Cell::from(DASH).class("unavailable").tooltip(&row.reason),
        Outcome::Right if row.artifact_px == 0 => {
            Cell::drawn(html! { "·" span.sr { " right" } }).class("none")
        }
        Outcome::Right => Cell::from(px).class("none"),
        Outcome::Declared => Cell::from(px).class(format!("declared{framed}")),
        Outcome::Failed => Cell::from("broke!")
            .class("undeclared")
            .tooltip(&row.reason),
        Outcome::Undeclared => Cell::from(px + "!").class(format!("undeclared{framed}")),
    }
}
