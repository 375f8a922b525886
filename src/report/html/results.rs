//! The results: the table that one reads, then all the figures behind it.

use maud::{Markup, html};

use super::shell::{Section, details, note};
use crate::record::statistics::median;
use crate::record::{Summary, summary_records, unique};
use crate::report::format::ms;
use crate::report::load::Run;
use crate::report::results;
use crate::report::table::{Cell, Column, Table};

pub(super) fn section(run: &Run) -> Section {
    let content = html! {
        @if run.summaries.is_empty() {
            p { "There are no results." }
        } @else {
            (results::table(run).html())
            (note(include_str!("notes/results.html")))
            (stage_times(run))
            (all_figures(run))
        }
    };
    Section::new("results", "Results", content)
}

/// The median of every stage of every method: where its shadow time goes.
fn stage_times(run: &Run) -> Markup {
    let rows = run.scenes().into_iter().flat_map(|scene| run.rows(scene));
    let medians = rows.flat_map(|row| stage_medians(run, row));
    let medians: Vec<(&Summary, &str, f64)> = medians.collect();
    let table = Table::of("Stages of each method", &medians)
        .text("Scene", |(row, ..)| row.scene.as_str())
        .text("Method", |(row, ..)| Cell::code(run.contender(row).label()))
        .text("Stage", |(_, stage, _)| *stage)
        .number(("Median", "ms"), |(.., stage_ms)| ms(*stage_ms));
    html! { @if !medians.is_empty() { (details("Stages of each method", &table.html())) } }
}

fn stage_medians<'a>(run: &'a Run, row: &'a Summary) -> Vec<(&'a Summary, &'a str, f64)> {
    let stages = || run.samples_of(row).flat_map(|sample| &sample.stages);
    let names = unique(stages().map(|stage| stage.stage.as_str()));
    let of = |name| {
        let own = stages().filter(|stage| stage.stage == name);
        let times_ms: Vec<f64> = own.map(|stage| stage.device_ms + stage.cpu_ms).collect();
        Some((row, name, median(&times_ms)?))
    };
    names.into_iter().filter_map(of).collect()
}

fn all_figures(run: &Run) -> Markup {
    // Rows in memory cannot fail to be written; one that did would only be missing here.
    let records = summary_records(&run.summaries).unwrap_or_default();
    let mut records = records.iter().map(|record| record.iter().map(Cell::from));
    let heads = records.next().into_iter().flatten().map(Column::text);
    let table = Table::new("All figures, unrounded", heads).class("all");
    let table = table.extend(records.map(Vec::from_iter));
    let note = note("The rows of summary.csv. Error counts are sums over the verified frames.");
    details("All figures, unrounded", &html! { (note) (table.html()) })
}
