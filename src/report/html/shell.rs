//! What all pages have in common: the frame around their content, facts, banners, notes, plots.

use maud::{DOCTYPE, Markup, PreEscaped, Render, html};

use crate::report::plots::Plot;

const STYLE: &str = concat!(
    include_str!("../report.css"),
    include_str!("../stability.css")
);

/// A part of a page, with a heading and a link at the top.
pub(crate) struct Section {
    pub id: String,
    pub title: String,
    /// The text of the link.
    pub link: String,
    pub content: Markup,
}

impl Section {
    pub(crate) fn new(id: &str, title: &str, content: Markup) -> Self {
        let [id, title, link] = [id, title, title].map(str::to_owned);
        Self {
            id,
            title,
            link,
            content,
        }
    }
}

/// A page: title, facts, links to the sections and banners above the sections.
pub(crate) fn page(title: &str, facts: &Markup, banners: &Markup, sections: &[Section]) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (title) " · svbench" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    p.kicker { "svbench · hard-shadow benchmark" }
                    h1 { (title) }
                    (facts)
                    nav aria-label="Sections" {
                        @for section in sections { a href={ "#" (section.id) } { (section.link) } }
                    }
                }
                main {
                    (banners)
                    @for Section { id, title, content, .. } in sections {
                        section id=(id) { h2 { (title) } (content) }
                    }
                }
            }
        }
    };
    page.into_string()
}

/// What a reader must know before any number. `class` is `grave`, `fine` or empty.
pub(super) fn banner(class: &str, lead: &str, rest: &str, items: &[Markup]) -> Markup {
    html! {
        div class={ "banner " (class) } role="note" {
            p { strong { (lead) } @if !rest.is_empty() { " " (rest) } }
            @if !items.is_empty() { ul { @for item in items { li { (item) } } } }
        }
    }
}

/// The prose of a file in `notes`, which is HTML.
pub(super) fn prose(text: &str) -> Markup {
    PreEscaped(text.trim_end().replace('\n', " "))
}

pub(crate) fn note(text: &str) -> Markup {
    html! { p.note { (prose(text)) } }
}

/// What is hidden until it is asked for.
pub(super) fn details(summary: impl Render, content: &Markup) -> Markup {
    html! { details { summary { (summary) } (content) } }
}

/// Names, and what stands under them.
pub(crate) fn facts<N: Render>(facts: &[(N, String)]) -> Markup {
    html! { dl.facts { @for (name, value) in facts { div { dt { (name) } dd { (value) } } } } }
}

/// Plots, one below the other.
pub(super) fn figures(plots: &[&Plot]) -> Markup {
    html! {
        div.plots {
            @for plot in plots {
                @let alt = format!("Plot: {}. The same figures are in the tables.", plot.title);
                figure.plot.large[plot.is_pareto] {
                    div.scroll tabindex="0" role="img" aria-label=(alt) { (PreEscaped(&plot.svg)) }
                }
            }
        }
    }
}

/// The section of the plots that are in no other; none where there are none.
pub(super) fn plots(plots: &[&Plot]) -> Option<Section> {
    (!plots.is_empty()).then(|| Section::new("plots", "Plots", figures(plots)))
}
