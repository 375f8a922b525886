//! The results: the table that one reads, then all the figures behind it.

use maud::{Markup, html};

use super::shell::{Section, details};
use crate::record::statistics::median;
use crate::record::{Summary, summary_records};
use crate::report::format::ms;
use crate::report::load::Run;
use crate::report::results;
use crate::report::table::{Cell, Column, Table};

/// The results section.
pub(super) fn section(run: &Run) -> Section {
    let content = html! {
        @if run.summaries.is_empty() {
            p { "There are no results." }
        } @else {
            (results::table(run).html())
            p.note {
                "Times are medians over the measured frames; shadow time is what a method adds "
                "to the frame. A wrong pixel is false lit or false shadowed; an " em { "artifact" }
                " is a wrong pixel farther than one pixel from the true shadow boundary; what is "
                em { "ambiguous" } " the reference itself cannot decide. "
                "Bold: the shortest shadow time in the scene among the methods without artifacts."
            }
            (stage_times(run))
            (all_figures(run))
        }
    };
    Section::new("results", "Results", content)
}

/// The median of every stage of every method: where its shadow time goes.
fn stage_times(run: &Run) -> Markup {
    let columns = [
        Column::text("Scene"),
        Column::text("Method"),
        Column::text("Stage"),
        Column::number("Median").unit("ms"),
    ];
    let mut table = Table::new("Stages of each method", columns);
    for row in run.scenes().iter().flat_map(|scene| run.rows(scene)) {
        let label = run.contender(row).label();
        table = table.extend(
            stage_medians(run, row)
                .into_iter()
                .map(|(stage, stage_ms)| {
                    let scene = row.scene.as_str().into();
                    [scene, Cell::code(&label), stage.into(), ms(stage_ms).into()]
                }),
        );
    }
    html! {
        @if !table.groups.is_empty() { (details("Stages of each method", &table.html())) }
    }
}

fn stage_medians(run: &Run, row: &Summary) -> Vec<(String, f64)> {
    let mut stages: Vec<(String, Vec<f64>)> = Vec::new();
    for sample in run.samples_of(row) {
        for stage in &sample.stages {
            let stage_ms = stage.device_ms + stage.cpu_ms;
            match stages.iter_mut().find(|(known, _)| *known == stage.stage) {
                Some((_, all)) => all.push(stage_ms),
                None => stages.push((stage.stage.clone(), vec![stage_ms])),
            }
        }
    }
    let medians = stages.into_iter();
    medians
        .filter_map(|(name, all)| Some((name, median(&all)?)))
        .collect()
}

/// Every row and column of the summary, unrounded.
fn all_figures(run: &Run) -> Markup {
    // Rows in memory cannot fail to be written; one that did would only be missing here.
    let records = summary_records(&run.summaries).unwrap_or_default();
    let mut records = records.into_iter();
    let heads = records.next().unwrap_or_default();
    let columns = heads.iter().map(Column::text);
    let rows = records.map(|record| record.iter().map(Cell::from).collect::<Vec<Cell>>());
    let table = Table::new("All figures, unrounded", columns)
        .class("all")
        .extend(rows);
    let note = "The rows of summary.csv. Error counts are sums over the verified frames.";
    let content = html! { p.note { (note) } (table.html()) };
    details("All figures, unrounded", &content)
}
