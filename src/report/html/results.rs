//! The results: the table that one reads, then all the figures behind it.

use maud::{Markup, html};

use super::shell::{Section, details, note};
use crate::record::{Summary, summary_records};
use crate::report::format::ms;
use crate::report::load::Run;
use crate::report::results;
use crate::report::table::{Cell, Column, Listing, Table};

pub(super) fn section(run: &Run) -> Section {
    let content = html! {
        @if run.summaries.is_empty() {
            p { "There are no results." }
        } @else {
            (results::table(run).html())
            (note(include_str!("notes/results.html")))
            (stage_times(run))
            (volumes(run))
            (all_figures(run))
        }
    };
    Section::new("results", "Results", content)
}

/// The median of every stage of every method: where its shadow time goes.
fn stage_times(run: &Run) -> Markup {
    let medians = |row| run.stage_medians(row).into_iter().map(move |m| (row, m));
    let medians: Vec<(&Summary, (&str, f64))> = rows(run).flat_map(medians).collect();
    let title = "Stages of each method";
    let table = of_rows(run, title, &medians)
        .text("Stage", |(_, (stage, _))| *stage)
        .number(("Median", "ms"), |(_, (_, stage_ms))| ms(*stage_ms));
    html! { @if !medians.is_empty() { (details(title, &table.html())) } }
}

/// How many volumes each method drew, on average over its frames.
fn volumes(run: &Run) -> Markup {
    let means = |row| Some((row, run.mean_volumes(row)?));
    let means: Vec<(&Summary, [f64; 5])> = rows(run).filter_map(means).collect();
    let title = "Volumes drawn, culled and hidden";
    let mut table = of_rows(run, title, &means);
    for (at, head) in (0..).zip(["Drawn", "Culled", "Hidden", "Queries"]) {
        table = table.number((head, "a frame"), move |(_, mean)| {
            format!("{:.1}", mean[at])
        });
    }
    let table = table.number(("Waiting", "ms"), |(_, mean)| ms(mean[4]));
    html! { @if !means.is_empty() { (details(title, &table.html())) } }
}

fn rows(run: &Run) -> impl Iterator<Item = &Summary> {
    run.scenes().into_iter().flat_map(|scene| run.rows(scene))
}

fn of_rows<'a, T>(
    run: &'a Run,
    title: &str,
    rows: &'a [(&Summary, T)],
) -> Listing<'a, (&'a Summary, T)> {
    Table::of(title, rows)
        .text("Scene", |(row, _)| row.scene.as_str())
        .text("Method", |(row, _)| Cell::code(run.contender(row).label()))
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
