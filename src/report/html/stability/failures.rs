//! The first failure of a method by a cause: its picture, and how to see it again.

use anyhow::Result;
use maud::{Markup, html};

use crate::file_name::file_name;
use crate::record::pairs_from_text;
use crate::record::stress::{FAILURES_DIR, GAP_PX, Outcome, StressRow};
use crate::report::format::{count, short};
use crate::report::html::errors::kinds;
use crate::report::html::pictures::Album;
use crate::report::stability::{Failure, Line, Matrix, StressRun};

/// Pixels of the page that a picture may be wide.
const PAGE_WIDTH_PX: u32 = 1190;

/// The pictures of failures, those of undeclared ones first.
pub(super) fn album(run: &StressRun, matrix: &Matrix<'_>) -> Result<Album> {
    let cells = matrix.lines.iter().flat_map(|line| &line.cells);
    let mut failures: Vec<&Failure<'_>> = cells.filter_map(|cell| cell.failure()).collect();
    failures.sort_by_key(|failure| failure.undeclared.is_none());
    let rows = failures.into_iter().flat_map(|failure| failure.shown());
    let pictures = rows.map(|row| vec![row.picture.clone()]);
    Album::read(&run.dir, FAILURES_DIR, pictures)
}

/// A failure: its picture, its numbers and a command.
pub(super) fn figure(run: &StressRun, line: &Line<'_>, row: &StressRow, album: &Album) -> Markup {
    let method = row.variant.full_name(&row.method);
    let pairs = pairs_from_text(&row.kinds);
    let kinds = kinds(pairs, count).map(|kinds| kinds.replace('_', " "));
    html! {
        figure.failure {
            (picture(run, line, row, album))
            figcaption {
                h4 { code { (method) } }
                p {
                    (line.cause.number) ": " strong { (short(row.value)) } " · "
                    strong { (count(row.artifact_px)) } " artifact px"
                }
                @match row.outcome {
                    Outcome::Declared => p { span.verdict.trend { "Declared: " } (row.reason) },
                    Outcome::Failed => p { span.verdict.broken { "! Not drawn" } ": " (row.reason) },
                    _ => p { span.verdict.broken { "! Undeclared" } ": no limit of the method says so" },
                }
                p.quiet {
                    (count(row.false_lit)) " px false lit, " (count(row.false_shadowed))
                    " false shadowed, " (count(row.boundary_px)) " of all at the boundary"
                }
                @if let Some(kinds) = kinds { p.quiet { "Kinds: " (kinds) } }
                pre.command { code { (command(run, row)) } }
            }
        }
    }
}

/// The command that draws the picture again, to be run in the directory of the run.
fn command(run: &StressRun, row: &StressRow) -> String {
    let stem = file_name(&format!("{}_{}", row.cause, row.value));
    let method = row.variant.full_name(&row.method);
    format!(
        "svbench render {FAILURES_DIR}/{stem}.toml --method {method} --size {}x{}",
        run.info.width, run.info.height
    )
}

fn picture(run: &StressRun, line: &Line<'_>, row: &StressRow, album: &Album) -> Markup {
    let (width, height) = (3 * run.info.width + 2 * GAP_PX, run.info.height);
    // By whole numbers, so that all pixels are of one size.
    let scale = (PAGE_WIDTH_PX / width.max(1)).max(1);
    let (width, height) = (width * scale, height * scale);
    let method = row.variant.full_name(&row.method);
    let alt = format!(
        "{}, {method} at {}: truth, shadow mask and errors side by side",
        line.cause.title,
        short(row.value)
    );
    html! {
        @match album.get(&row.picture) {
            None => p.missing { "The picture is missing." },
            Some(picture) if !picture.is_held => p.missing { a href=(picture.address) { (row.picture) } },
            Some(picture) => div.triple style={ "width:" (width) "px" } {
                div.parts aria-hidden="true" { span { "Truth" } span { "Shadow mask" } span { "Errors" } }
                img tabindex="0" loading="lazy" src=(picture.address) alt=(alt) width=(width) height=(height);
            },
        }
    }
}
