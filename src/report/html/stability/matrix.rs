//! The matrix: a row a cause, a column a method.

use maud::{Markup, html};

use super::{breakable, cause_id, failure_id};
use crate::record::stress::StressMethod;
use crate::report::format::{count, short};
use crate::report::html::shell::Section;
use crate::report::stability::{self, Failure, Line, Matrix};
use crate::report::table::{Cell, Column, DASH, Table};

/// The section of the matrix.
pub(super) fn section(matrix: &Matrix<'_>) -> Section {
    let content = html! {
        p.note {
            "A cell says the first value of the cause at which the method fails, and below it the artifact "
            "pixels there and, after the arrow, where they are the most. Artifacts are wrong pixels "
            "farther than one pixel from the true shadow boundary. Follow a cell to its picture."
        }
        ul.key-list {
            li { span.sample.right { "·" } "right at every value" }
            li { span.sample.declared { "257" } "fails, by a limit that the method declares" }
            li { span.sample.undeclared { "257!" } "fails, and no limit declares it" }
            li { span.sample.unavailable { "–" } "unavailable" }
        }
        (table(matrix).html())
    };
    Section::new("matrix", "Where methods fail", content)
}

fn table(matrix: &Matrix<'_>) -> Table {
    let cause = Column::heads(Cell::from("Cause").class("stay"), "stay");
    let methods = matrix
        .methods
        .iter()
        .map(|method| Column::number(Cell::drawn(head(method))));
    let columns = [cause].into_iter().chain(methods);
    let rows = matrix.lines.iter().map(|line| {
        let cause = Cell::link(cause_id(line), &line.cause.id).small(&line.cause.number);
        let cells = line.cells.iter().enumerate();
        let cells = cells.map(|(index, cell)| self::cell(line, index, cell));
        [cause].into_iter().chain(cells).collect::<Vec<Cell>>()
    });
    let mut table = Table::new("Matrix of causes and methods", columns)
        .class("matrix")
        .extend(rows);
    let totals = (0..matrix.methods.len()).map(|index| total(matrix, index));
    let foot: Vec<Cell> = [Cell::from("Causes that fail")]
        .into_iter()
        .chain(totals)
        .collect();
    table.foot = Some(foot.into());
    table
}

fn head(method: &StressMethod) -> Markup {
    html! {
        code { (breakable(&method.id)) }
        @for (name, value) in method.variant.parameters() {
            small { (breakable(&format!("{name}={value}"))) }
        }
    }
}

fn cell(line: &Line<'_>, index: usize, cell: &stability::Cell<'_>) -> Cell {
    match cell {
        stability::Cell::Untried => Cell::drawn(html! { span.sr { "not tried" } }),
        stability::Cell::Unavailable { reason } => {
            let hidden = html! { (DASH) span.sr { " unavailable" } };
            Cell::drawn(hidden).class("unavailable").tooltip(reason)
        }
        stability::Cell::Right {
            unavailable,
            cut_off,
        } => {
            let right = Cell::drawn(html! { "·" span.sr { " right" } }).class("right");
            match unavailable {
                _ if *cut_off => right.small("as far as tried"),
                0 => right,
                _ => right.small(format!("– at {unavailable}")),
            }
        }
        stability::Cell::Fails(failure) => failing(line, index, failure),
    }
}

fn failing(line: &Line<'_>, index: usize, failure: &Failure<'_>) -> Cell {
    let (first, worst) = (failure.first.artifact_px, failure.worst.artifact_px);
    let is_undeclared = failure.undeclared.is_some();
    let mark = if failure.begins_undeclared() { "!" } else { "" };
    let link = html! {
        a href={ "#" (failure_id(line, index)) } {
            (short(failure.first.value)) (mark)
            @if let Some(later) = failure.undeclared.filter(|_| !failure.begins_undeclared()) {
                ", " (short(later.value)) "!"
            }
            @if is_undeclared { span.sr { " undeclared" } }
        }
    };
    let px = match worst == first {
        true => count(first),
        false => format!("{} → {}", count(first), count(worst)),
    };
    let class = if is_undeclared {
        "undeclared"
    } else {
        "declared"
    };
    Cell::drawn(link).small(px).class(class)
}

/// How many causes bring a method down.
fn total(matrix: &Matrix<'_>, index: usize) -> Cell {
    let cells = matrix.lines.iter().map(|line| &line.cells[index]);
    let failures: Vec<&Failure<'_>> = cells.filter_map(stability::Cell::failure).collect();
    let total = Cell::from(failures.len().to_string());
    match failures.iter().filter(|f| f.undeclared.is_some()).count() {
        0 => total,
        undeclared => total.small(format!("{undeclared} undeclared")),
    }
}
