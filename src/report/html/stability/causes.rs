//! A section for each cause: what it is, how many pixels are wrong at each value, and pictures.

use super::cause_id;
use super::failures::{Album, figures};
use crate::record::stress::{Outcome, StressMethod, StressRow};
use crate::report::LegendEntry;
use crate::report::format::{count, short};
use crate::report::html::gallery::legend_list;
use crate::report::stability::{Cell, Line, Matrix, StressRun};
use anyhow::Result;
use maud::{Markup, html};

/// The sections of all causes.
pub(super) fn section(
    run: &StressRun,
    matrix: &Matrix<'_>,
    legend: &[LegendEntry],
) -> Result<Markup> {
    let album = Album::of(run, matrix);
    let mut causes = Vec::new();
    for line in &matrix.lines {
        causes.push(cause(run, matrix, line, &album)?);
    }
    Ok(html! {
        section #causes {
            h2 { "Causes" }
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
        }
    })
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
    let is_tried = line.cells.iter().any(|cell| *cell != Cell::Untried);
    Ok(html! {
        article.cause id=(cause_id(line)) {
            h3 { (line.cause.title) " " code.quiet { (line.cause.id) } }
            p.why { (line.cause.why) }
            @if is_tried { (table(run, matrix, line)) }
            @else { p.quiet { "Not tried: the run was interrupted before." } }
            @for figures in failures { (figures) }
        }
    })
}

/// Methods in rows and values in columns: what turns up reads from left to right. Methods with nothing
/// to show are a sentence below.
fn table(run: &StressRun, matrix: &Matrix<'_>, line: &Line<'_>) -> Markup {
    let label = format!("Artifact pixels: {}", line.cause.title);
    let (mut clean, mut unavailable, mut rows) = (Vec::new(), Vec::new(), Vec::new());
    for (method, cell) in matrix.methods.iter().zip(&line.cells) {
        let is_clean = || {
            let rows = run.rows_of(line.cause, method);
            rows.iter().all(|row| row.artifact_px == 0)
        };
        match cell {
            Cell::Unavailable { .. } => unavailable.push(method.name()),
            Cell::Right { unavailable: 0, .. } if is_clean() => clean.push(method.name()),
            _ => rows.push((method, cell)),
        }
    }
    html! {
        @if !rows.is_empty() {
            div.scroll tabindex="0" role="region" aria-label=(label) {
                table.values {
                    thead { tr {
                        th.stay scope="col" { "Artifact px by " (line.cause.number) }
                        @for value in &line.cause.values { th scope="col" { (short(*value)) } }
                    } }
                    tbody {
                        @for (method, cell) in rows { (row(run, line, method, cell)) }
                    }
                }
            }
        }
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

fn row(run: &StressRun, line: &Line<'_>, method: &StressMethod, cell: &Cell<'_>) -> Markup {
    let rows = run.rows_of(line.cause, method);
    let first = cell.failure().map(|failure| failure.first.value);
    let at = |value: f64| rows.iter().find(|row| row.value == value).copied();
    html! {
        tr {
            th.stay scope="row" {
                code { (method.id) }
                @if !method.variant.is_empty() { small { (method.variant.as_str().replace(',', ", ")) } }
            }
            @for &value in &line.cause.values {
                @if let Some(row) = at(value) { (value_cell(row, first == Some(value))) }
                @else { td {} }
            }
        }
    }
}

fn value_cell(row: &StressRow, is_first: bool) -> Markup {
    let px = count(row.artifact_px);
    match row.outcome {
        Outcome::Unavailable => html! { td.unavailable title=(row.reason) { "–" } },
        Outcome::Right if row.artifact_px == 0 => html! { td.none { "·" span.sr { " right" } } },
        Outcome::Right => html! { td.none { (px) } },
        Outcome::Declared => html! { td.declared.first[is_first] { (px) } },
        Outcome::Failed => html! { td.undeclared title=(row.reason) { "broke!" } },
        Outcome::Undeclared => html! { td.undeclared.first[is_first] { (px) "!" } },
    }
}
