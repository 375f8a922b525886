//! The limits that were hit, and why methods were unavailable.

use crate::record::stress::{Outcome, StressRow};
use crate::report::format::{count, short};
use crate::report::stability::{StressRun, Unseen};
use maud::{Markup, html};

/// Pictures that share a reason.
struct Reason<'a> {
    text: &'a str,
    methods: Vec<String>,
    causes: Vec<&'a str>,
    pictures: u64,
}

/// The section; `None` where there is nothing to say.
pub(super) fn section(run: &StressRun) -> Option<Markup> {
    let limits = reasons(run, Outcome::Declared);
    let absences = reasons(run, Outcome::Unavailable);
    let unseen = run.unseen();
    if limits.is_empty() && absences.is_empty() && unseen.is_empty() {
        return None;
    }
    Some(html! {
        section #limits {
            h2 { "Limits" }
            @if !limits.is_empty() {
                p.note { "What methods declare that they cannot do, and this run has seen." }
                (table("Limit", &limits))
            }
            @if !unseen.is_empty() {
                h3 { "Declared, not seen" }
                p.note {
                    "What methods declare and this run has not seen at the value that they name. No failure, but "
                    "a limit that may be gone, or begin later."
                }
                (unseen_table(&unseen))
            }
            @if !absences.is_empty() {
                h3 { "Unavailable" }
                (table("Reason", &absences))
            }
        }
    })
}

/// The reasons of pictures of this outcome, in the order in which they come.
fn reasons(run: &StressRun, outcome: Outcome) -> Vec<Reason<'_>> {
    let mut reasons: Vec<Reason<'_>> = Vec::new();
    for row in run.rows.iter().filter(|row| row.outcome == outcome) {
        let place = reasons.iter().position(|known| known.text == row.reason);
        let place = place.unwrap_or_else(|| {
            reasons.push(Reason {
                text: &row.reason,
                methods: Vec::new(),
                causes: Vec::new(),
                pictures: 0,
            });
            reasons.len() - 1
        });
        reasons[place].add(row);
    }
    reasons
}

impl<'a> Reason<'a> {
    fn add(&mut self, row: &'a StressRow) {
        let method = format!("{} {}", row.method, row.variant)
            .trim_end()
            .to_owned();
        if !self.methods.contains(&method) {
            self.methods.push(method);
        }
        if !self.causes.contains(&row.cause.as_str()) {
            self.causes.push(&row.cause);
        }
        self.pictures += 1;
    }
}

fn unseen_table(unseen: &[Unseen<'_>]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Declared, not seen" {
            table.limits {
                thead { tr {
                    th.text scope="col" { "Limit" }
                    th.text scope="col" { "Method" }
                    th.text scope="col" { "Cause" }
                    th scope="col" { "Declared from" }
                    th scope="col" { "Right at" }
                    th scope="col" { "Wrong from" }
                } }
                tbody {
                    @for Unseen { method, declared, value, seen_at } in unseen {
                        tr {
                            td.text { (declared.limit) }
                            td.text { code { (method.name()) } }
                            td.text { a href={ "#cause-" (declared.cause) } { (declared.cause) } }
                            td { (short(declared.from)) }
                            td { (short(*value)) }
                            td { @match seen_at { Some(value) => (short(*value)), None => "–" } }
                        }
                    }
                }
            }
        }
    }
}

fn table(head: &str, reasons: &[Reason<'_>]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label=(head) {
            table.limits {
                thead { tr {
                    th.text scope="col" { (head) }
                    th.text scope="col" { "Methods" }
                    th.text scope="col" { "Causes" }
                    th scope="col" { "Pictures" }
                } }
                tbody {
                    @for reason in reasons {
                        tr {
                            td.text { (reason.text) }
                            td.text { @for method in &reason.methods { div { code { (method) } } } }
                            td.text {
                                @for (place, cause) in reason.causes.iter().enumerate() {
                                    @if place > 0 { ", " }
                                    a href={ "#cause-" (cause) } { (cause) }
                                }
                            }
                            td { (count(reason.pictures)) }
                        }
                    }
                }
            }
        }
    }
}
