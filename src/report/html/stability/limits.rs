//! The limits that were hit, and why methods were unavailable.

use maud::{Markup, html};

use super::cause_link;
use crate::record::stress::{Outcome, StressRow};
use crate::record::unique;
use crate::report::curve::Contender;
use crate::report::format::short;
use crate::report::html::shell::{Section, note};
use crate::report::stability::{StressRun, Unseen};
use crate::report::table::{Cell, Part, Table};

/// The section; none where there is nothing to say.
pub(super) fn section(run: &StressRun) -> Option<Section> {
    let limits = reasons(run, "Limit", Outcome::Declared);
    let absences = reasons(run, "Reason", Outcome::Unavailable);
    let unseen = run.unseen();
    let content = html! {
        @if !limits.rows.is_empty() {
            (note("What methods declare that they cannot do, and this run has seen."))
            (limits.html())
        }
        @if !unseen.is_empty() {
            h3 { "Declared, not seen" }
            (note(include_str!("../notes/unseen.html")))
            (unseen_table(&unseen))
        }
        @if !absences.rows.is_empty() { h3 { "Unavailable" } (absences.html()) }
    };
    let is_empty = limits.rows.is_empty() && absences.rows.is_empty() && unseen.is_empty();
    (!is_empty).then(|| Section::new("limits", "Limits", content))
}

fn unseen_table(unseen: &[Unseen<'_>]) -> Markup {
    Table::of("Declared, not seen", unseen)
        .class("limits")
        .text("Limit", |unseen| unseen.declared.limit.as_str())
        .text("Method", |unseen| Cell::code(unseen.method.name()))
        .text("Cause", |unseen| cause_link(&unseen.declared.cause))
        .number("Declared from", |unseen| short(unseen.declared.from))
        .number("Right at", |unseen| short(unseen.value))
        .number("Wrong from", |unseen| unseen.seen_at.map(short))
        .html()
}

/// The reasons of pictures of this outcome, in the order in which they come.
fn reasons(run: &StressRun, head: &str, outcome: Outcome) -> Table {
    let rows = || run.rows.iter().filter(|row| row.outcome == outcome);
    let reasons = unique(rows().map(|row| row.reason.as_str())).into_iter();
    let of = |reason| (reason, rows().filter(|row| row.reason == reason).collect());
    let reasons: Vec<(&str, Vec<&StressRow>)> = reasons.map(of).collect();
    let table = Table::of(head, &reasons)
        .class("limits")
        .text(head, |(reason, _)| *reason)
        .text("Methods", |(_, rows)| methods(rows))
        .text("Causes", |(_, rows)| causes(rows))
        .number("Pictures", |(_, rows)| rows.len() as u64);
    table.table
}

fn methods(rows: &[&StressRow]) -> Cell {
    let method = |row: &&StressRow| Contender::new(&row.method, row.variant.as_str()).label();
    let methods = unique(rows.iter().map(method));
    Cell::drawn(html! { @for method in &methods { div { code { (method) } } } })
}

fn causes(rows: &[&StressRow]) -> Cell {
    let mut cell = Cell::default();
    for cause in unique(rows.iter().map(|row| &row.cause)) {
        if !cell.parts.is_empty() {
            cell = cell.with(Part::Text(", ".to_owned()));
        }
        cell = cell.with(cause_link(cause));
    }
    cell
}
