//! A paper's tables with measured devices beside the published ones, and its claims.

use maud::{Markup, html};

use super::shell::{Section, banner, details};
use crate::report::paper::Paper;
use crate::report::paper::ledger::{Ledger, SOFTWARE_NOTE};

/// The sections of a paper.
pub(super) fn sections(paper: &Paper) -> [Section; 2] {
    let published = paper.published;
    let prefix = &published.prefix;
    // The first paper's headings need no name: its sections are *the* paper's.
    let title = |alone: &str, of: &str| match prefix.as_str() {
        "" => alone.to_owned(),
        _ => format!("{of} of {}", published.short),
    };
    let tables = html! {
        p.note {
            (published.authors) ": " em { (published.title) } ", " (published.year) ". Published numbers stand "
            "beside measured ones. They come from other hardware and another flight: compare how methods rank and "
            "scale, not the values."
        }
        @for sheet in &paper.sheets {
            h3 { (sheet.title()) }
            (sheet.table().html())
            ul.note { @for note in sheet.notes() { li { (note) } } }
        }
    };
    let claims = title("The paper's claims", "Claims");
    let link = title("Its claims", "Claims");
    [
        Section::new(
            format!("{prefix}paper"),
            title("The paper's tables", "Tables"),
            tables,
        ),
        Section::new(format!("{prefix}ledger"), claims, ledger(&paper.ledger)).linked(link),
    ]
}

fn ledger(ledger: &Ledger) -> Markup {
    let rules = html! {
        dl.settings {
            @for (ids, rule) in ledger.rules() {
                dt { @for id in ids.split(", ") { code { (id) } br; } }
                dd { (rule) }
            }
        }
    };
    html! {
        @for device in &ledger.software { (banner("", device, SOFTWARE_NOTE, &[])) }
        (ledger.table().html())
        p.note {
            "\u{201c}Rests on\u{201d} counts comparisons: two measured cells held against each "
            "other, of as many as the paper's tables have for the claim."
        }
        (details("How verdicts are reached", &rules))
    }
}
