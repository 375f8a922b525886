//! The page of several runs: the paper's tables and claims, and where each run comes from.

use maud::{Markup, html};

use super::shell::{self, Section, banner};
use super::{banners, paper, provenance};
use crate::report::format::number_of;
use crate::report::groups::Group;
use crate::report::load::Run;
use crate::report::paper::Paper;
use crate::report::plots::Plot;

pub(crate) fn page(groups: &[Group<'_>], papers: &[Paper], plots: &[Plot]) -> String {
    let mut sections: Vec<Section> = papers.iter().flat_map(paper::sections).collect();
    sections.extend(shell::plots(&plots.iter().collect::<Vec<_>>()));
    let runs = html! {
        @for group in groups { @for run in &group.runs { (run_facts(&group.label, run)) } }
    };
    sections.push(Section::new("provenance", "Provenance", runs));
    let banners = notes(groups, papers);
    let devices = groups.iter();
    let devices = devices.map(|g| (number_of(g.runs.len(), "run"), g.label.clone()));
    let devices = shell::facts(&devices.collect::<Vec<_>>());
    shell::page("Runs beside the paper", &devices, &banners, &sections)
}

fn notes(groups: &[Group<'_>], papers: &[Paper]) -> Markup {
    let runs = groups.iter().flat_map(|group| group.runs.iter());
    let unfinished = runs.filter_map(|run| {
        let what = banners::unfinished(run.info.status)?;
        Some(html! { code { (run.dir.display()) } ": " (what) })
    });
    let unfinished: Vec<Markup> = unfinished.collect();
    let missing = "None of these runs has a cell of the paper's tables.";
    html! {
        @if !unfinished.is_empty() {
            (banner("grave", "Not all runs are complete.", "What they left is shown.", &unfinished))
        }
        @if papers.is_empty() { (banner("grave", "Nothing to compare.", missing, &[])) }
        @for group in groups.iter().filter(|group| group.software) { (banners::software(&group.label)) }
    }
}

fn run_facts(label: &str, run: &Run) -> Markup {
    let info = &run.info;
    html! {
        h3 { (info.title) span.quiet { " " (label) } }
        (provenance::run_facts(info))
        dl.settings {
            dt { "Directory" } dd { code { (run.dir.display()) } }
            dt { "Configuration" } dd {
                code { (info.config_path) } ", scale: " @if info.scale.is_empty() { "full" } @else { (info.scale) }
            }
            dt { "Started" } dd { (info.started) }
            dt { "Shaders" } dd { code { (info.shader_hash) } }
        }
        (provenance::warnings(&run.warnings))
    }
}
