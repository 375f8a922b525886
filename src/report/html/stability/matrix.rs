//! The matrix: a row a cause, a column a method.

use maud::{Markup, PreEscaped, html};

use super::{cause_link, failure_id};
use crate::record::stress::StressMethod;
use crate::report::format::{count, short};
use crate::report::html::shell::{Section, note};
use crate::report::stability::{self, Failure, Line, Matrix};
use crate::report::table::{Cell, Column, DASH, Table};

pub(super) fn section(matrix: &Matrix<'_>) -> Section {
    let content = html! {
        (note(include_str!("../notes/matrix.html")))
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
    let mut listing = Table::of("Matrix of causes and methods", &matrix.lines)
        .class("matrix")
        .column(cause, |line| {
            Cell::from(cause_link(&line.cause.id)).small(&line.cause.number)
        });
    let mut totals = vec![Cell::from("Causes that fail")];
    for (index, method) in matrix.methods.iter().enumerate() {
        listing = listing.number(Cell::drawn(head(method)), |line| cell(line, index));
        totals.push(total(matrix, index));
    }
    listing.table.foot = Some(totals.into());
    listing.table
}

fn head(method: &StressMethod) -> Markup {
    html! {
        code { (breakable(&method.id)) }
        @for (name, value) in method.variant.parameters() {
            small { (breakable(&format!("{name}={value}"))) }
        }
    }
}

/// Text that may break after an underscore and an equals sign, so that columns stay narrow.
fn breakable(name: &str) -> Markup {
    html! {
        @for part in name.split_inclusive(['_', '=']) {
            (part) @if part.ends_with(['_', '=']) { (PreEscaped("<wbr>")) }
        }
    }
}

fn cell(line: &Line<'_>, index: usize) -> Cell {
    match &line.cells[index] {
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
        stability::Cell::Fails(failure) => failing(&failure_id(line, index), failure),
    }
}

fn failing(id: &str, failure: &Failure<'_>) -> Cell {
    let later = failure.undeclared.filter(|_| !failure.begins_undeclared());
    let link = html! {
        a href={ "#" (id) } {
            (short(failure.first.value)) @if failure.begins_undeclared() { "!" }
            @if let Some(later) = later { ", " (short(later.value)) "!" }
            @if failure.undeclared.is_some() { span.sr { " undeclared" } }
        }
    };
    let (first, worst) = (failure.first.artifact_px, failure.worst.artifact_px);
    let then = (worst != first).then(|| format!(" → {}", count(worst)));
    let px = count(first) + &then.unwrap_or_default();
    let class = failure.undeclared.map_or("declared", |_| "undeclared");
    Cell::drawn(link).small(px).class(class)
}

/// How many causes bring a method down.
fn total(matrix: &Matrix<'_>, index: usize) -> Cell {
    let cells = matrix.lines.iter().map(|line| &line.cells[index]);
    let failures: Vec<&Failure<'_>> = cells.filter_map(stability::Cell::failure).collect();
    let total = Cell::from(failures.len() as u64);
    match failures.iter().filter(|f| f.undeclared.is_some()).count() {
        0 => total,
        undeclared => total.small(format!("{undeclared} undeclared")),
    }
}
