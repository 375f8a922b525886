//! What all pages have in common: the frame around their content, facts, banners, plots.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::record::DeviceRecord;
use crate::report::format::date;
use crate::report::load::Run;
use crate::report::plots::Plot;

const STYLE: &str = concat!(
    include_str!("../report.css"),
    include_str!("../stability.css")
);

/// A part of a page, with a heading and a link at the top.
pub(super) struct Section {
    id: String,
    title: String,
    /// The text of the link, where it is not the title.
    link: Option<String>,
    content: Markup,
}

impl Section {
    pub(super) fn new(id: impl Into<String>, title: impl Into<String>, content: Markup) -> Self {
        Self {
            id: id.into(),
            title: title.into(),
            link: None,
            content,
        }
    }

    /// The section, with another text of its link.
    pub(super) fn linked(self, link: String) -> Self {
        let link = Some(link);
        Self { link, ..self }
    }
}

/// A page: title, facts, links to the sections and banners above the sections.
pub(super) fn page(title: &str, facts: &Markup, banners: &Markup, sections: &[Section]) -> String {
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
                        @for Section { id, title, link, .. } in sections {
                            a href={ "#" (id) } { (link.as_ref().unwrap_or(title)) }
                        }
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

/// What is hidden until it is asked for.
pub(super) fn details(summary: &(impl maud::Render + ?Sized), content: &Markup) -> Markup {
    html! { details { summary { (summary) } (content) } }
}

/// A name, and what stands under it.
pub(super) type Fact = (&'static str, String);

pub(super) fn facts_list(facts: &[Fact]) -> Markup {
    html! {
        dl.facts {
            @for (name, value) in facts {
                div { dt { (name) } dd { (value) } }
            }
        }
    }
}

/// What every number of a run depends on.
pub(super) fn facts(run: &Run) -> Markup {
    let info = &run.info;
    let [device, driver] = device_facts(&info.device);
    let frames = format!(
        "{} measured, {} verified, {} to warm up",
        count(info.frames),
        count(info.verified_frames),
        count(info.warmup_frames)
    );
    facts_list(&[
        device,
        driver,
        ("Measured", date(&info.started)),
        ("Program", program(&info.program_version, &info.program_git)),
        ("Picture", format!("{} × {} px", info.width, info.height)),
        ("Frames per cell", frames),
    ])
}

fn count(number: u32) -> String {
    crate::report::format::count(number.into())
}

pub(super) fn device_facts(device: &DeviceRecord) -> [Fact; 2] {
    let driver = format!("{} {}", device.driver, device.driver_info);
    [
        ("Device", device.name.clone()),
        ("Driver", format!("{} · {}", driver.trim(), device.backend)),
    ]
}

pub(super) fn program(version: &str, git: &str) -> String {
    format!("svbench {version} {git}").trim_end().to_owned()
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
