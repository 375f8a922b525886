//! The results of a run: scenes as groups of rows, methods as rows.

use super::format::{count, fps, ms, px_per_frame};
use super::load::Run;
use super::table::{Cell, Column, Part, Row, Table};
use crate::record::{Status, Summary};

const NOTES: &str = "Times are medians over the measured frames. Pixels are per verified frame; \
    artifacts are the wrong pixels farther than one pixel from the true shadow boundary. Bold: the \
    shortest shadow time in the scene among the methods without artifacts.";

pub(crate) fn markdown(run: &Run) -> String {
    if run.summaries.is_empty() {
        return "Nothing was measured.\n".to_owned();
    }
    format!("{}\n{NOTES}\n", table(run).markdown())
}

pub(super) fn table(run: &Run) -> Table {
    let pixels = |head| Column::number(head).over("Pixels per verified frame");
    let columns = [
        Column::heads("Method", "method"),
        Column::number("FPS"),
        Column::number(("Frame", "ms")),
        Column::number(("median", "ms"))
            .over("Shadow")
            .plain("Shadow ms"),
        Column::number(("p95", "ms")).over("Shadow").plain("p95"),
        Column::number(("G-buffer", "ms")),
        pixels("false\nlit").plain("False lit px"),
        pixels("false\nshadowed").plain("False shadowed px"),
        pixels("artifact").plain("Artifact px"),
        pixels("ambiguous").plain("Ambiguous px"),
        Column::text("Status"),
    ];
    let mut table = Table::new("Results by scene and method", columns).class("results");
    for scene in run.scenes() {
        let summaries = run.rows(scene);
        let (wide, plain) = heads(run, scene, summaries.first().copied());
        table.begin(wide, vec![plain]);
        match run.absence(scene) {
            Some((status, reason)) => table.push(Row {
                reason: reason.to_owned(),
                ..[status_cell(status.word())].into()
            }),
            None => table = table.extend(summaries.into_iter().map(|summary| row(run, summary))),
        }
    }
    table
}

/// The head of a scene's rows, on the page and elsewhere.
fn heads(run: &Run, scene: &str, first: Option<&Summary>) -> (Cell, Cell) {
    let [triangles, objects] = [
        first.and_then(|row| row.triangles),
        first.and_then(|row| row.objects),
    ];
    let size = triangles
        .zip(objects)
        .map_or_else(String::new, |(triangles, objects)| {
            format!(", {} tri, {} obj", count(triangles), count(objects))
        });
    let record = run.scene(scene);
    let known = maud::html! {
        @if let Some(triangles) = triangles.or(record.and_then(|scene| scene.triangles)) {
            " " (count(triangles)) " triangles"
        }
        @if let Some(objects) = objects.or(record.and_then(|scene| scene.objects)) {
            " · " (count(objects)) " objects"
        }
    };
    let title = run.scene_title(scene);
    let wide = maud::html! { span.stay { (title) span.quiet { (known) } } };
    (
        Cell::drawn(wide),
        Cell::strong(title).with(Part::Text(size)),
    )
}

fn row(run: &Run, row: &Summary) -> Row {
    let contender = run.contender(row);
    let method = Cell::method(&contender.method, &contender.variant);
    let status = status_cell(status(row));
    let reason = row.reason.clone();
    if row.is_absent() {
        return Row {
            reason,
            ..[method, status].into()
        };
    }
    let px = |sum: Option<u64>| sum.map(|sum| px_per_frame(sum, row.verified_frames)).into();
    let shadow_ms = match row.shadow_ms_median.map(ms) {
        Some(shadow_ms) if run.is_best(row) => Cell::strong(shadow_ms),
        shadow_ms => shadow_ms.into(),
    };
    let cells = [
        method,
        row.fps.map(fps).into(),
        row.frame_ms_median.map(ms).into(),
        shadow_ms,
        row.shadow_ms_p95.map(ms).into(),
        row.gbuffer_ms_median.map(ms).into(),
        px(row.false_lit),
        px(row.false_shadowed),
        px(row.artifact_px),
        px(row.ambiguous_px),
        status,
    ];
    Row {
        reason,
        ..cells.into()
    }
}

fn status_cell(word: &str) -> Cell {
    Cell::from(word).class(format!("status {word}"))
}

/// The row's status; a measured row whose mask is wrong says so.
fn status(row: &Summary) -> &'static str {
    match (row.status, row.artifact_px) {
        (Status::Ok, Some(1..)) => "wrong",
        (status, _) => status.word(),
    }
}
