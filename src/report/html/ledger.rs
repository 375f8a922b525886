//! The ledger: the paper's claims and what became of them.

use maud::{Markup, html};

use crate::report::paper::check::{Finding, Verdict};
use crate::report::paper::ledger::{Entry, Ledger, OWN_TABLES, SOFTWARE_NOTE, rests_on};

/// The section of the ledger.
pub(super) fn section(ledger: &Ledger) -> Markup {
    html! {
        section #ledger {
            h2 { "The paper's claims" }
            @for device in &ledger.software {
                div.banner role="note" { p { strong { (device) } " " (SOFTWARE_NOTE) } }
            }
            div.scroll tabindex="0" role="region" aria-label="The paper's claims" {
                table.ledger {
                    thead {
                        tr {
                            th.text scope="col" { "Device" }
                            th.text scope="col" { "Verdict" }
                            th.text scope="col" { "Rests on" }
                            th.text scope="col" { "Found" }
                        }
                    }
                    @for entry in &ledger.entries { (claim(entry)) }
                }
            }
            p.note {
                "\u{201c}Rests on\u{201d} counts comparisons: two measured cells held against each "
                "other, of as many as the paper's tables have for the claim."
            }
            details {
                summary { "How verdicts are reached" }
                dl.settings {
                    @for (ids, rule) in ledger.rules() {
                        dt { @for id in ids.split(", ") { code { (id) } br; } }
                        dd { (rule) }
                    }
                }
            }
        }
    }
}

fn claim(
    Entry {
        claim,
        paper,
        devices,
    }: &Entry,
) -> Markup {
    html! {
        tbody {
            tr.scene {
                th scope="rowgroup" colspan="4" {
                    (claim.text)
                    span.quiet { " Claimed: " (claim.claimed) ". " code { (claim.id) } }
                }
            }
            tr {
                td.text { (OWN_TABLES) }
                td.text {}
                td.text { (rests_on(paper)) }
                td.found {
                    (paper.text)
                    @if !claim.note.is_empty() { small { (claim.note) } }
                }
            }
            @for (device, finding) in devices { (measured(device, finding)) }
        }
    }
}

fn measured(device: &str, finding: &Finding) -> Markup {
    let class = match finding.verdict {
        Verdict::Reproduced => "verdict held",
        Verdict::TrendOnly => "verdict trend",
        Verdict::NotReproduced => "verdict broken",
        Verdict::NotMeasured => "verdict quiet",
    };
    html! {
        tr {
            td.text { (device) }
            td.text { span class=(class) { (finding.verdict.word()) } }
            td.text { (rests_on(finding)) }
            td.found { (finding.text) }
        }
    }
}
