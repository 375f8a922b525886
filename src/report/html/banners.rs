//! What a reader must know before any number: banners at the top of the page.

use maud::{Markup, html};

use super::shell::banner;
use crate::record::{RunStatus, Status, Summary};
use crate::report::curve::Contender;
use crate::report::format::{number_of, px_per_frame};
use crate::report::load::Run;

/// The banners that the run calls for, the gravest first.
pub(super) fn of(run: &Run) -> Markup {
    let rows = |which: fn(&Summary) -> bool| -> Vec<&Summary> {
        run.summaries.iter().filter(|row| which(row)).collect()
    };
    let wrong = rows(|row| row.artifact_px.is_some_and(|px| px > 0));
    let failed = rows(|row| row.status == Status::Failed);
    let unverified = rows(|row| row.status == Status::Unverified);
    let reason = |row: &&Summary| {
        let (scene, contender) = (run.scene_title(&row.scene), run.contender(row));
        html! { (scene) ", " (contender.label()) ": " (row.reason) }
    };
    let reasons: Vec<Markup> = failed.iter().map(reason).collect();
    html! {
        @if let Some(text) = unfinished(run.info.status) {
            (banner("grave", text, "What follows is what it left.", &[]))
        }
        @if run.summaries.iter().all(|row| row.frames == 0) {
            (banner("grave", "Nothing was measured.", "The run directory holds no frame times.", &[]))
        }
        @if !wrong.is_empty() {
            (banner(
                "grave",
                &format!("{} wrong.", are(&wrong)),
                "Pixels differ from the ray-traced reference farther than one pixel from the true shadow boundary. \
                    Read these times together with their errors:",
                &wrong_by_contender(run, &wrong),
            ))
        }
        @if !failed.is_empty() {
            (banner("grave", &format!("{} failed:", number_of(failed.len(), "cell")), "", &reasons))
        }
        @if run.info.device.is_software() { (software(&run.info.device.name)) }
        @if !unverified.is_empty() {
            @let lead = format!("{} unverified.", are(&unverified));
            (banner("", &lead, "Measured, but not compared with the reference.", &[]))
        }
    }
}

/// What must be known of a device that is none.
pub(super) fn software(device: &str) -> Markup {
    let rest = format!(
        "{device} renders on the processor. The pictures and error counts hold; the times say nothing about a GPU."
    );
    banner("", "Software device.", &rest, &[])
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

fn are(cells: &[&Summary]) -> String {
    let verb = if cells.len() == 1 { "is" } else { "are" };
    format!("{} {verb}", number_of(cells.len(), "cell"))
}

/// A line per contender, not per cell: a method that is wrong is mostly wrong everywhere.
fn wrong_by_contender(run: &Run, wrong: &[&Summary]) -> Vec<Markup> {
    let sum_px = |row: &Summary| row.artifact_px.unwrap_or_default();
    let per_frame = |row: &Summary| sum_px(row) as f64 / f64::from(row.verified_frames);
    let line = |contender: &Contender| {
        let rows = wrong.iter().filter(|row| run.contender(row) == *contender);
        let scenes = rows.clone().count();
        let worst = rows.max_by(|a, b| per_frame(a).total_cmp(&per_frame(b)))?;
        let px = px_per_frame(sum_px(worst), worst.verified_frames);
        let scene = run.scene_title(&worst.scene);
        Some(html! {
            (contender.label()) ": "
            @if scenes == 1 { (px) " artifact pixels per frame in " (scene) }
            @else { "in " (scenes) " scenes, up to " (px) " artifact pixels per frame (" (scene) ")" }
        })
    };
    run.contenders().iter().filter_map(line).collect()
}
