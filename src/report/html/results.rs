//! The results: the table that one reads, then all the figures behind it.

use maud::{Markup, html};

use super::shell::{Section, details};
use crate::record::statistics::median;
use crate::record::{Summary, pairs_from_text};
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
        for (name, stage_ms) in pairs_from_text::<f64>(&sample.stages) {
            match stages.iter_mut().find(|(known, _)| known == name) {
                Some((_, all)) => all.push(stage_ms),
                None => stages.push((name.to_owned(), vec![stage_ms])),
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
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in &run.summaries {
        // Writing plain rows to memory cannot fail; a row that did would only be missing here.
        let _ = writer.serialize(row);
    }
    let bytes = writer.into_inner().unwrap_or_default();
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let heads = reader.headers().cloned().unwrap_or_default();
    let columns = heads.iter().map(Column::text);
    let rows = reader.records().flatten();
    let rows = rows.map(|record| record.iter().map(Cell::from).collect::<Vec<Cell>>());
    let table = Table::new("All figures, unrounded", columns)
        .class("all")
        .extend(rows);
    let note = "The rows of summary.csv. Error counts are sums over the verified frames.";
    let content = html! { p.note { (note) } (table.html()) };
    details("All figures, unrounded", &content)
}
