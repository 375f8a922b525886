//! What a reader must know before any number: banners at the top of the page.

use maud::{Markup, html};

use super::shell::banner;
use crate::record::{RunStatus, Status, Summary};
use crate::report::format::{number_of, px_per_frame};
use crate::report::load::Run;

/// The banners that the run calls for, the gravest first.
pub(super) fn of(run: &Run) -> Markup {
    let measured = run.summaries.iter().filter(|row| row.frames > 0).count();
    let wrong = rows(run, |row| row.artifact_px.is_some_and(|px| px > 0));
    let failed = rows(run, |row| row.status == Status::Failed);
    let unverified = rows(run, |row| row.status == Status::Unverified);
    let mut banners = Vec::new();
    if let Some(text) = unfinished(run.info.status) {
        banners.push(banner("grave", text, "What follows is what it left.", &[]));
    }
    if measured == 0 {
        let rest = "The run directory holds no frame times.";
        banners.push(banner("grave", "Nothing was measured.", rest, &[]));
    }
    if !wrong.is_empty() {
        let lead = format!("{} wrong.", are(wrong.len()));
        let rest = "Pixels differ from the ray-traced reference farther than one pixel from the true shadow \
            boundary. Read these times together with their errors:";
        banners.push(banner(
            "grave",
            &lead,
            rest,
            &wrong_by_contender(run, &wrong),
        ));
    }
    if !failed.is_empty() {
        let lead = format!("{} failed:", number_of(failed.len(), "cell"));
        let reasons: Vec<Markup> = failed.iter().map(|row| reason(run, row)).collect();
        banners.push(banner("grave", &lead, "", &reasons));
    }
    if run.info.device.is_software() {
        banners.push(software(&run.info.device.name));
    }
    if !unverified.is_empty() {
        let lead = format!("{} unverified.", are(unverified.len()));
        let rest = "Measured, but not compared with the reference.";
        banners.push(banner("", &lead, rest, &[]));
    }
    html! { @for banner in banners { (banner) } }
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

fn rows(run: &Run, which: fn(&Summary) -> bool) -> Vec<&Summary> {
    run.summaries.iter().filter(|row| which(row)).collect()
}

fn are(cells: usize) -> String {
    let verb = if cells == 1 { "is" } else { "are" };
    format!("{} {verb}", number_of(cells, "cell"))
}

fn reason(run: &Run, row: &Summary) -> Markup {
    let (scene, contender) = (run.scene_title(&row.scene), run.contender(row));
    html! { (scene) ", " (contender.label()) ": " (row.reason) }
}

/// A line per contender, not per cell: a method that is wrong is mostly wrong everywhere.
fn wrong_by_contender(run: &Run, wrong: &[&Summary]) -> Vec<Markup> {
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
        lines.push(html! {
            @if scenes == 1 { (name) ": " (px) " artifact pixels per frame in " (scene) }
            @else { (name) ": in " (scenes) " scenes, up to " (px) " artifact pixels per frame (" (scene) ")" }
        });
    }
    lines
}
