//! The results as a Markdown table.

use crate::record::{Status, Summary};

use super::format::{count, fps, ms, px_per_frame};
use super::load::Run;
use super::markdown::{align, escape};

const HEAD: [&str; 11] = [
    "Method",
    "FPS",
    "Frame ms",
    "Shadow ms",
    "p95",
    "G-buffer ms",
    "False lit px",
    "False shadowed px",
    "Artifact px",
    "Ambiguous px",
    "Status",
];
/// Columns that hold text and so are set to the left; the others hold numbers.
const TEXT_COLUMNS: [usize; 2] = [0, 10];
const NOTES: &str = "Times are medians over the measured frames. Pixels are per verified frame; \
    artifacts are the wrong pixels farther than one pixel from the true shadow boundary. Bold: the \
    shortest shadow time in the scene among the methods without artifacts.";

/// The table of a run: scenes as groups of rows, methods as rows.
pub fn markdown(run: &Run) -> String {
    let mut rows: Vec<Vec<String>> = vec![HEAD.map(str::to_owned).to_vec()];
    for scene in run.scenes() {
        let summaries = run.rows(scene);
        let mut group = group(run, scene, summaries.first().copied());
        match run.absence(scene) {
            Some((status, reason)) => {
                group[HEAD.len() - 1] = format!("{}: {}", status.word(), escape(reason));
                rows.push(group);
            }
            None => {
                rows.push(group);
                rows.extend(summaries.iter().map(|summary| row(run, summary)));
            }
        }
    }
    if run.summaries.is_empty() {
        return "Nothing was measured.\n".to_owned();
    }
    format!("{}\n{NOTES}\n", align(&rows, &TEXT_COLUMNS))
}

fn group(run: &Run, scene: &str, first: Option<&Summary>) -> Vec<String> {
    let mut title = format!("**{}**", escape(run.scene_title(scene)));
    if let Some((triangles, objects)) = first.and_then(|row| row.triangles.zip(row.objects)) {
        title.push_str(&format!(
            ", {} tri, {} obj",
            count(triangles),
            count(objects)
        ));
    }
    let mut cells = vec![String::new(); HEAD.len()];
    cells[0] = title;
    cells
}

fn row(run: &Run, row: &Summary) -> Vec<String> {
    let px = |sum: Option<u64>| text(sum.map(|sum| px_per_frame(sum, row.verified_frames)));
    let shadow_ms = text(row.shadow_ms_median.map(ms));
    vec![
        escape(&run.contender(row).label()),
        text(row.fps.map(fps)),
        text(row.frame_ms_median.map(ms)),
        if run.is_best(row) {
            format!("**{shadow_ms}**")
        } else {
            shadow_ms
        },
        text(row.shadow_ms_p95.map(ms)),
        text(row.gbuffer_ms_median.map(ms)),
        px(row.false_lit),
        px(row.false_shadowed),
        px(row.artifact_px),
        px(row.ambiguous_px),
        if row.reason.is_empty() {
            status(row).to_owned()
        } else {
            format!("{}: {}", status(row), escape(&row.reason))
        },
    ]
}

/// The row's status; a measured row whose mask is wrong says so.
pub(super) fn status(row: &Summary) -> &'static str {
    match (row.status, row.artifact_px) {
        (Status::Ok, Some(1..)) => "wrong",
        (status, _) => status.word(),
    }
}

fn text(value: Option<String>) -> String {
    value.unwrap_or_else(|| "–".to_owned())
}
