//! The results: the table that one reads, then all the figures behind it.

use maud::{Markup, PreEscaped, html};

use super::or_dash;
use crate::record::statistics::median;
use crate::record::{Summary, summary_records};
use crate::report::format::{count, fps, ms, px_per_frame};
use crate::report::load::Run;
use crate::report::table::status;

/// The results section.
pub(super) fn section(run: &Run) -> Markup {
    html! {
        section #results {
            h2 { "Results" }
            @if run.summaries.is_empty() {
                p { "There are no results." }
            } @else {
                (table(run))
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
        }
    }
}

fn table(run: &Run) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Results by scene and method" {
            table.results {
                thead {
                    tr {
                        th scope="col" rowspan="2" { "Method" }
                        th scope="col" rowspan="2" { "FPS" }
                        th scope="col" rowspan="2" { "Frame" small { "ms" } }
                        th.group scope="colgroup" colspan="2" { "Shadow" }
                        th scope="col" rowspan="2" { "G-buffer" small { "ms" } }
                        th.group scope="colgroup" colspan="4" { "Pixels per verified frame" }
                        th.text scope="col" rowspan="2" { "Status" }
                    }
                    tr {
                        th scope="col" { "median" small { "ms" } }
                        th scope="col" { "p95" small { "ms" } }
                        th scope="col" { "false" br; "lit" }
                        th scope="col" { "false" br; "shadowed" }
                        th scope="col" { "artifact" }
                        th scope="col" { "ambiguous" }
                    }
                }
                @for scene in run.scenes() {
                    tbody {
                        (scene_row(run, scene))
                        @match run.absence(scene) {
                            Some((status, reason)) => {
                                tr.absent {
                                    td.text.why colspan="10" { (reason) }
                                    td.text { span class={ "status " (status.word()) } { (status.word()) } }
                                }
                            }
                            None => @for summary in run.rows(scene) { (row(run, summary)) },
                        }
                    }
                }
            }
        }
    }
}

fn scene_row(run: &Run, scene: &str) -> Markup {
    let record = run.info.scenes.iter().find(|record| record.name == scene);
    let first = run.rows(scene).first().copied();
    let triangles = first
        .and_then(|row| row.triangles)
        .or(record.and_then(|r| r.triangles));
    let objects = first
        .and_then(|row| row.objects)
        .or(record.and_then(|r| r.objects));
    html! {
        tr.scene {
            th scope="rowgroup" colspan="11" {
                span.stay {
                    (run.scene_title(scene))
                    span.quiet {
                        @if let Some(triangles) = triangles { " " (count(triangles)) " triangles" }
                        @if let Some(objects) = objects { " · " (count(objects)) " objects" }
                    }
                }
            }
        }
    }
}

fn row(run: &Run, row: &Summary) -> Markup {
    let contender = run.contender(row);
    html! {
        tr.absent[row.status.is_absent()] {
            th.method scope="row" {
                code { (contender.method) }
                @if !contender.variant.is_empty() { " " span.quiet { (breakable(&contender.variant)) } }
            }
            @if row.is_absent() {
                td.text.why colspan="9" { (row.reason) }
            } @else {
                (number(row.fps.map(fps)))
                (number(row.frame_ms_median.map(ms)))
                td {
                    @match row.shadow_ms_median.map(ms) {
                        Some(shadow_ms) if run.is_best(row) => strong { (shadow_ms) },
                        shadow_ms => (or_dash(shadow_ms)),
                    }
                }
                (number(row.shadow_ms_p95.map(ms)))
                (number(row.gbuffer_ms_median.map(ms)))
                (pixels(row, row.false_lit))
                (pixels(row, row.false_shadowed))
                (pixels(row, row.artifact_px))
                (pixels(row, row.ambiguous_px))
            }
            td.text { span class={ "status " (status(row)) } { (status(row)) } }
        }
        @if row.frames > 0 && !row.reason.is_empty() {
            tr.remark { td.text.why colspan="11" { (row.reason) } }
        }
    }
}

/// A variant that may break between two parameters.
pub(super) fn breakable(variant: &str) -> Markup {
    html! {
        @for part in variant.split_inclusive(',') { (part) (PreEscaped("<wbr>")) }
    }
}

fn number(text: Option<String>) -> Markup {
    html! { td { (or_dash(text)) } }
}

fn pixels(row: &Summary, sum_px: Option<u64>) -> Markup {
    number(sum_px.map(|sum_px| px_per_frame(sum_px, row.verified_frames)))
}

/// The median of every stage of every method: where its shadow time goes.
fn stage_times(run: &Run) -> Markup {
    let rows: Vec<(&Summary, Vec<(String, f64)>)> = run
        .scenes()
        .iter()
        .flat_map(|scene| run.rows(scene))
        .map(|row| (row, stage_medians(run, row)))
        .filter(|(_, stages)| !stages.is_empty())
        .collect();
    html! {
        @if !rows.is_empty() {
            details {
                summary { "Stages of each method" }
                div.scroll tabindex="0" role="region" aria-label="Stages of each method" {
                    table {
                        thead {
                            tr {
                                th.text scope="col" { "Scene" }
                                th.text scope="col" { "Method" }
                                th.text scope="col" { "Stage" }
                                th scope="col" { "Median" small { "ms" } }
                            }
                        }
                        tbody {
                            @for (row, stages) in &rows {
                                @for (stage, stage_ms) in stages {
                                    tr {
                                        td.text { (row.scene) }
                                        td.text { code { (run.contender(row).label()) } }
                                        td.text { (stage) }
                                        td { (ms(*stage_ms)) }
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
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
    stages
        .into_iter()
        .filter_map(|(name, all)| Some((name, median(&all)?)))
        .collect()
}

/// Every row and column of the summary, unrounded.
fn all_figures(run: &Run) -> Markup {
    // Rows in memory cannot fail to be written; one that did would only be missing here.
    let mut records = summary_records(&run.summaries)
        .unwrap_or_default()
        .into_iter();
    let head = records.next().unwrap_or_default();
    html! {
        details {
            summary { "All figures, unrounded" }
            p.note { "The rows of summary.csv. Error counts are sums over the verified frames." }
            div.scroll tabindex="0" role="region" aria-label="All figures, unrounded" {
                table.all {
                    thead { tr { @for name in &head { th.text scope="col" { (name) } } } }
                    tbody {
                        @for record in records {
                            tr { @for field in &record { td.text { (field) } } }
                        }
                    }
                }
            }
        }
    }
}
