//! The page of several runs: the paper's tables and claims, and where each run comes from.

use maud::{Markup, html};

use super::provenance::warnings;
use super::shell::{Section, banner, facts, page as shell_page, plots as plots_section};
use super::{banners, paper};
use crate::report::format::number_of;
use crate::report::groups::Group;
use crate::report::load::Run;
use crate::report::paper::Paper;
use crate::report::plots::Plot;

/// The page of the groups' runs.
pub(crate) fn page(groups: &[Group<'_>], papers: &[Paper], plots: &[Plot]) -> String {
    let mut sections: Vec<Section> = papers.iter().flat_map(paper::sections).collect();
    sections.extend(plots_section(&plots.iter().collect::<Vec<_>>()));
    let runs = html! {
        @for group in groups {
            @for run in &group.runs { (run_facts(&group.label, run)) }
        }
    };
    sections.push(Section::new("provenance", "Provenance", runs));
    let banners = notes(groups, papers);
    shell_page(
        "Runs beside the paper",
        &devices(groups),
        &banners,
        &sections,
    )
}

/// The groups, and how many runs each has.
fn devices(groups: &[Group<'_>]) -> Markup {
    html! {
        dl.facts {
            @for group in groups {
                div { dt { (number_of(group.runs.len(), "run")) } dd { (group.label) } }
            }
        }
    }
}

fn notes(groups: &[Group<'_>], papers: &[Paper]) -> Markup {
    let runs = groups.iter().flat_map(|group| group.runs.iter());
    let unfinished = runs.filter_map(|run| {
        let what = banners::unfinished(run.info.status)?;
        Some(html! { code { (run.dir.display()) } ": " (what) })
    });
    let unfinished: Vec<Markup> = unfinished.collect();
    let software = groups.iter().filter(|group| group.software);
    let missing = "None of these runs has a cell of the paper's tables.";
    html! {
        @if !unfinished.is_empty() {
            (banner("grave", "Not all runs are complete.", "What they left is shown.", &unfinished))
        }
        @if papers.is_empty() { (banner("grave", "Nothing to compare.", missing, &[])) }
        @for group in software { (banners::software(&group.label)) }
    }
}

fn run_facts(label: &str, run: &Run) -> Markup {
    let info = &run.info;
    let scale = match info.scale.as_str() {
        "" => "full",
        scale => scale,
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
        @if !run.warnings.is_empty() { (warnings(&run.warnings)) }
    }
}
