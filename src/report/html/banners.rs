//! What a reader must know before any number: banners at the top of the page.

use maud::{Markup, html};

use crate::record::{RunStatus, Status, Summary};
use crate::report::format::px_per_frame;
use crate::report::load::Run;

/// The banners that the run calls for, the gravest first.
pub(super) fn section(run: &Run) -> Markup {
    let measured = run.summaries.iter().filter(|row| row.frames > 0).count();
    let wrong = rows(run, |row| row.artifact_px.is_some_and(|px| px > 0));
    let failed = rows(run, |row| row.status == Status::Failed);
    let unverified = rows(run, |row| row.status == Status::Unverified);
    html! {
        @if let Some(text) = unfinished(run.info.status) {
            div.banner.grave role="note" { p { strong { (text) } " What follows is what it left." } }
        }
        @if measured == 0 {
            div.banner.grave role="note" {
                p { strong { "Nothing was measured." } " The run directory holds no frame times." }
            }
        }
        @if !wrong.is_empty() {
            div.banner.grave role="note" {
                p {
                    strong { (are(wrong.len())) " wrong." }
                    " Pixels differ from the ray-traced reference farther than one pixel from the "
                    "true shadow boundary. Read these times together with their errors:"
                }
                ul {
                    @for line in wrong_by_contender(run, &wrong) { li { (line) } }
                }
            }
        }
        @if !failed.is_empty() {
            div.banner.grave role="note" {
                p { strong { (cells(failed.len())) " failed:" } }
                ul { @for row in failed { li { (name(run, row)) ": " (row.reason) } } }
            }
        }
        @if run.info.device.is_software() {
            div.banner role="note" {
                p { (software(&run.info.device.name)) }
            }
        }
        @if !unverified.is_empty() {
            div.banner role="note" {
                p {
                    strong { (are(unverified.len())) " unverified." }
                    " Measured, but not compared with the reference."
                }
            }
        }
    }
}

/// What must be known of a device that is none.
pub(super) fn software(device: &str) -> Markup {
    html! {
        strong { "Software device." }
        " " (device) " renders on the processor. The pictures and error counts hold; the times say "
        "nothing about a GPU."
    }
}

/// What became of a run that is not complete.
pub(super) fn unfinished(status: RunStatus) -> Option<&'static str> {
    match status {
        RunStatus::Complete => None,
        RunStatus::Running => Some("This run is still going, or was killed."),
        RunStatus::Interrupted => Some("This run was interrupted."),
        RunStatus::Failed => Some("This run failed."),
    }
}

fn rows(run: &Run, which: fn(&Summary) -> bool) -> Vec<&Summary> {
    run.summaries.iter().filter(|row| which(row)).collect()
}

fn cells(number: usize) -> String {
    if number == 1 {
        "1 cell".to_owned()
    } else {
        format!("{number} cells")
    }
}

fn are(number: usize) -> String {
    format!(
        "{} {}",
        cells(number),
        if number == 1 { "is" } else { "are" }
    )
}

/// A line per contender, not per cell: a method that is wrong is mostly wrong everywhere.
fn wrong_by_contender(run: &Run, wrong: &[&Summary]) -> Vec<String> {
    let sum_px = |row: &Summary| row.artifact_px.unwrap_or_default();
    let per_frame = |row: &Summary| sum_px(row) as f64 / f64::from(row.verified_frames);
    let mut lines = Vec::new();
    for contender in run.contenders() {
        let rows = wrong.iter().filter(|row| run.contender(row) == contender);
        let scenes = rows.clone().count();
        let Some(worst) = rows.max_by(|a, b| per_frame(a).total_cmp(&per_frame(b))) else {
            continue;
        };
        let name = contender.label();
        let px = px_per_frame(sum_px(worst), worst.verified_frames);
        let scene = run.scene_title(&worst.scene);
        lines.push(if scenes == 1 {
            format!("{name}: {px} artifact pixels per frame in {scene}")
        } else {
            format!("{name}: in {scenes} scenes, up to {px} artifact pixels per frame ({scene})")
        });
    }
    lines
}

fn name(run: &Run, row: &Summary) -> String {
    format!(
        "{}, {}",
        run.scene_title(&row.scene),
        run.contender(row).label()
    )
}
