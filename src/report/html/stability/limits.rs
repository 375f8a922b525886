//! The limits that were hit, and why methods were unavailable.

use maud::html;

use crate::record::stress::Outcome;
use crate::report::format::{count, short};
use crate::report::html::shell::Section;
use crate::report::stability::{StressRun, Unseen};
use crate::report::table::{Cell, Column, Part, Table};

/// Pictures that share a reason.
#[derive(Default)]
struct Reason<'a> {
    text: &'a str,
    methods: Vec<String>,
    causes: Vec<&'a str>,
    pictures: u64,
}

/// The section; none where there is nothing to say.
pub(super) fn section(run: &StressRun) -> Option<Section> {
    let limits = reasons(run, Outcome::Declared);
    let absences = reasons(run, Outcome::Unavailable);
    let unseen = run.unseen();
    if limits.is_empty() && absences.is_empty() && unseen.is_empty() {
        return None;
    }
    let content = html! {
        @if !limits.is_empty() {
            p.note { "What methods declare that they cannot do, and this run has seen." }
            (table("Limit", &limits).html())
        }
        @if !unseen.is_empty() {
            h3 { "Declared, not seen" }
            p.note {
                "What methods declare and this run has not seen at the value that they name. No failure, but "
                "a limit that may be gone, or begin later."
            }
            (unseen_table(&unseen).html())
        }
        @if !absences.is_empty() {
            h3 { "Unavailable" }
            (table("Reason", &absences).html())
        }
    };
    Some(Section::new("limits", "Limits", content))
}

/// The reasons of pictures of this outcome, in the order in which they come.
fn reasons(run: &StressRun, outcome: Outcome) -> Vec<Reason<'_>> {
    let mut reasons: Vec<Reason<'_>> = Vec::new();
    for row in run.rows.iter().filter(|row| row.outcome == outcome) {
        let place = reasons.iter().position(|known| known.text == row.reason);
        let place = place.unwrap_or_else(|| {
            reasons.push(Reason {
                text: &row.reason,
                ..Reason::default()
            });
            reasons.len() - 1
        });
        let reason = &mut reasons[place];
        let method = format!("{} {}", row.method, row.variant)
            .trim_end()
            .to_owned();
        if !reason.methods.contains(&method) {
            reason.methods.push(method);
        }
        if !reason.causes.contains(&row.cause.as_str()) {
            reason.causes.push(&row.cause);
        }
        reason.pictures += 1;
    }
    reasons
}

fn cause_link(cause: &str) -> Part {
    Part::Link(format!("cause-{cause}"), cause.to_owned())
}

fn unseen_table(unseen: &[Unseen<'_>]) -> Table {
    let columns = [
        Column::text("Limit"),
        Column::text("Method"),
        Column::text("Cause"),
        Column::number("Declared from"),
        Column::number("Right at"),
        Column::number("Wrong from"),
    ];
    let rows = unseen.iter().map(|unseen| {
        let declared = unseen.declared;
        [
            declared.limit.as_str().into(),
            Cell::code(unseen.method.name()),
            Cell::default().with(cause_link(&declared.cause)),
            short(declared.from).into(),
            short(unseen.value).into(),
            unseen.seen_at.map(short).into(),
        ]
    });
    Table::new("Declared, not seen", columns)
        .class("limits")
        .extend(rows)
}

fn table(head: &str, reasons: &[Reason<'_>]) -> Table {
    let columns = [
        Column::text(head),
        Column::text("Methods"),
        Column::text("Causes"),
        Column::number("Pictures"),
    ];
    let rows = reasons.iter().map(|reason| {
        let mut causes = Cell::default();
        for (place, cause) in reason.causes.iter().enumerate() {
            if place > 0 {
                causes = causes.with(Part::Text(", ".to_owned()));
            }
            causes = causes.with(cause_link(cause));
        }
        let methods = html! { @for method in &reason.methods { div { code { (method) } } } };
        [
            reason.text.into(),
            Cell::drawn(methods),
            causes,
            count(reason.pictures).into(),
        ]
    });
    Table::new(head, columns).class("limits").extend(rows)
}
