//! The page of several runs: the paper's tables and claims, and where each run comes from.

use maud::{Markup, html};

use super::{banners, facts, links_to, paper_sections, plots_section, shell};
use crate::report::groups::Group;
use crate::report::load::Run;
use crate::report::paper::Paper;
use crate::report::plots::Plot;

/// The page of the groups' runs.
pub(crate) fn page(groups: &[Group<'_>], paper: Option<&Paper>, plots: &[Plot]) -> String {
    let plots: Vec<&Plot> = plots.iter().collect();
    let mut links = links_to(paper, !plots.is_empty());
    links.push(("provenance", "Provenance"));
    let main = html! {
        (notes(groups, paper))
        (paper_sections(paper))
        (plots_section(&plots))
        (provenance(groups))
    };
    let title = "Runs beside the paper";
    shell(title, &devices(groups), &links, &main)
}

/// The groups, and how many runs each has.
fn devices(groups: &[Group<'_>]) -> Markup {
    html! {
        dl.facts {
            @for group in groups {
                div {
                    dt {
                        @match group.runs.len() { 1 => { "1 run" } n => { (n) " runs" } }
                    }
                    dd { (group.label) }
                }
            }
        }
    }
}

fn notes(groups: &[Group<'_>], paper: Option<&Paper>) -> Markup {
    let runs = || groups.iter().flat_map(|group| group.runs.iter());
    let unfinished: Vec<(&Run, &str)> = runs()
        .filter_map(|run| Some((*run, banners::unfinished(run.info.status)?)))
        .collect();
    html! {
        @if !unfinished.is_empty() {
            div.banner.grave role="note" {
                p { strong { "Not all runs are complete." } " What they left is shown." }
                ul {
                    @for (run, what) in unfinished {
                        li { code { (run.dir.display()) } ": " (what) }
                    }
                }
            }
        }
        @if paper.is_none() {
            div.banner.grave role="note" {
                p {
                    strong { "Nothing to compare." }
                    " None of these runs has a cell of the paper's tables."
                }
            }
        }
        @for group in groups.iter().filter(|group| group.software) {
            div.banner role="note" { p { (banners::software(&group.label)) } }
        }
    }
}

fn provenance(groups: &[Group<'_>]) -> Markup {
    html! {
        section #provenance {
            h2 { "Provenance" }
            @for group in groups {
                @for run in &group.runs { (run_facts(&group.label, run)) }
            }
        }
    }
}

fn run_facts(label: &str, run: &Run) -> Markup {
    let info = &run.info;
    let scale = if info.scale.is_empty() {
        "full"
    } else {
        &info.scale
    };
    html! {
        h3 { (info.title) span.quiet { " " (label) } }
        (facts(run))
        dl.settings {
            dt { "Directory" } dd { code { (run.dir.display()) } }
            dt { "Configuration" } dd { code { (info.config_path) } ", scale: " (scale) }
            dt { "Started" } dd { (info.started) }
            dt { "Shaders" } dd { code { (info.shader_hash) } }
        }
        @if !run.warnings.is_empty() {
            ul.warnings { @for warning in &run.warnings { li { (warning) } } }
        }
    }
}
