//! A paper's tables with measured devices beside the published ones, and its claims.

use maud::{Markup, html};

use super::shell::{Section, banner, details, note, prose};
use crate::report::paper::Paper;
use crate::report::paper::ledger::{Ledger, SOFTWARE_NOTE};

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
            (published.authors) ": " em { (published.title) } ", " (published.year) ". "
            (prose(include_str!("notes/published.html")))
        }
        @for sheet in &paper.sheets {
            h3 { (sheet.title()) }
            (sheet.table().html())
            ul.note { @for note in sheet.notes() { li { (note) } } }
        }
    };
    let ledger = ledger(&paper.ledger);
    let name = title("The paper's tables", "Tables");
    let claims = title("The paper's claims", "Claims");
    [
        Section::new(&format!("{prefix}paper"), &name, tables),
        Section {
            link: title("Its claims", "Claims"),
            ..Section::new(&format!("{prefix}ledger"), &claims, ledger)
        },
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
        (note(include_str!("notes/evidence.html")))
        (details("How verdicts are reached", &rules))
    }
}
