//! The matrix: a row a cause, a column a method.

use super::{breakable, cause_id, failure_id, first_value};
use crate::record::stress::StressMethod;
use crate::report::format::{count, short};
use crate::report::stability::{Cell, Failure, Line, Matrix};
use maud::{Markup, html};

/// The section of the matrix.
pub(super) fn section(matrix: &Matrix<'_>) -> Markup {
    html! {
        section #matrix {
            h2 { "Where methods fail" }
            p.note {
                "A cell says the first value of the cause at which the method fails, and below it the artifact "
                "pixels there and, after the arrow, where they are the most. Artifacts are wrong pixels "
                "farther than one pixel from the true shadow boundary. Follow a cell to its picture."
            }
            (key())
            div.scroll tabindex="0" role="region" aria-label="Matrix of causes and methods" {
                table.matrix {
                    thead { tr {
                        th.stay scope="col" { "Cause" }
                        @for method in matrix.methods { (head(method)) }
                    } }
                    tbody {
                        @for line in &matrix.lines {
                            tr {
                                th.stay scope="row" {
                                    a href={ "#" (cause_id(line)) } { (line.cause.id) }
                                    small { (line.cause.number) }
                                }
                                @for (index, cell) in line.cells.iter().enumerate() {
                                    (self::cell(line, index, cell))
                                }
                            }
                        }
                    }
                    tfoot { tr {
                        th.stay scope="row" { "Causes that fail" }
                        @for index in 0..matrix.methods.len() { (total(matrix, index)) }
                    } }
                }
            }
        }
    }
}

/// What the cells look like.
fn key() -> Markup {
    html! {
        ul.key-list {
            li { span.sample.right { "·" } "right at every value" }
            li { span.sample.declared { "257" } "fails, by a limit that the method declares" }
            li { span.sample.undeclared { "257!" } "fails, and no limit declares it" }
            li { span.sample.unavailable { "–" } "unavailable" }
        }
    }
}

fn head(method: &StressMethod) -> Markup {
    html! {
        th scope="col" {
            code { (breakable(&method.id)) }
            @for (name, value) in method.variant.parameters() {
                small { (breakable(&format!("{name}={value}"))) }
            }
        }
    }
}

fn cell(line: &Line<'_>, index: usize, cell: &Cell<'_>) -> Markup {
    match cell {
        Cell::Untried => html! { td { span.sr { "not tried" } } },
        Cell::Unavailable { reason } => html! {
            td.unavailable title=(reason) { "–" span.sr { " unavailable" } }
        },
        Cell::Right {
            unavailable,
            cut_off,
        } => html! {
            td.right {
                "·" span.sr { " right" }
                @if *cut_off { small { "as far as tried" } }
                @else if *unavailable > 0 { small { "– at " (unavailable) } }
            }
        },
        Cell::Fails(failure) => failing(line, index, failure),
    }
}

fn failing(line: &Line<'_>, index: usize, failure: &Failure<'_>) -> Markup {
    let (first, worst) = (failure.first.artifact_px, failure.worst.artifact_px);
    let is_undeclared = failure.undeclared.is_some();
    html! {
        td.declared[!is_undeclared].undeclared[is_undeclared] {
            a href={ "#" (failure_id(line, index)) } {
                (first_value(failure))
                @if let Some(later) = failure.undeclared.filter(|_| !failure.begins_undeclared()) {
                    ", " (short(later.value)) "!"
                }
                @if is_undeclared { span.sr { " undeclared" } }
            }
            small {
                (count(first))
                @if worst != first { " → " (count(worst)) }
            }
        }
    }
}

/// How many causes bring a method down.
fn total(matrix: &Matrix<'_>, index: usize) -> Markup {
    let cells = matrix.lines.iter().map(|line| &line.cells[index]);
    let failures: Vec<&Failure<'_>> = cells.filter_map(Cell::failure).collect();
    let undeclared = failures.iter().filter(|f| f.undeclared.is_some()).count();
    html! {
        td {
            (failures.len())
            @if undeclared > 0 { small { (undeclared) " undeclared" } }
        }
    }
}
