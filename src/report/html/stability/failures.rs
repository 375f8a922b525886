//! The first failure of a method by a cause: its picture, and how to see it again.

use super::failure_id;
use crate::file_name::file_name;
use crate::record::pairs_from_text;
use crate::record::stress::{FAILURES_DIR, GAP_PX, Outcome, StressRow};
use crate::report::format::{count, short};
use crate::report::html::pictures::{Held, data_uri, size_bytes};
use crate::report::stability::{Failure, Line, Matrix, StressRun};
use anyhow::Result;
use maud::{Markup, html};

/// Pixels of the page that a picture may be wide.
const PAGE_WIDTH_PX: u32 = 1190;

/// The pictures that the page holds; others it links to.
pub(super) type Album<'a> = Held<&'a str>;

impl<'a> Album<'a> {
    /// Those of undeclared failures first.
    pub(super) fn of(run: &StressRun, matrix: &Matrix<'a>) -> Self {
        let cells = matrix.lines.iter().flat_map(|line| &line.cells);
        let mut failures: Vec<&Failure<'a>> = cells.filter_map(|cell| cell.failure()).collect();
        failures.sort_by_key(|failure| failure.undeclared.is_none());
        let rows = failures.into_iter().flat_map(|failure| failure.shown());
        let folder = run.dir.join(FAILURES_DIR);
        Self::as_many_as_fit(rows.map(|row| {
            let name = row.picture.as_str();
            (name, size_bytes(&folder.join(name)))
        }))
    }
}

/// The first failure of the method in column `index`, and its first undeclared one if that is another.
pub(super) fn figures(
    run: &StressRun,
    line: &Line<'_>,
    index: usize,
    failure: &Failure<'_>,
    album: &Album<'_>,
) -> Result<Markup> {
    let method = run.info.methods[index].name();
    let figures = failure
        .shown()
        .map(|row| figure(run, line, &method, row, album));
    let figures: Vec<Markup> = figures.collect::<Result<_>>()?;
    Ok(html! {
        div id=(failure_id(line, index)) { @for figure in &figures { (figure) } }
    })
}

fn figure(
    run: &StressRun,
    line: &Line<'_>,
    method: &str,
    row: &StressRow,
    album: &Album<'_>,
) -> Result<Markup> {
    let picture = picture(run, line, row, method, album)?;
    Ok(html! {
        figure.failure {
            (picture)
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
                @if !row.kinds.is_empty() { p.quiet { "Kinds: " (kinds(row)) } }
                pre.command { code { (command(run, row)) } }
            }
        }
    })
}

/// The kinds of error by pixels, most first.
fn kinds(row: &StressRow) -> String {
    let mut kinds: Vec<(&str, u64)> = pairs_from_text(&row.kinds);
    kinds.retain(|(_, px)| *px > 0);
    kinds.sort_by_key(|(_, px)| std::cmp::Reverse(*px));
    let texts = kinds
        .iter()
        .map(|(name, px)| format!("{} {}", name.replace('_', " "), count(*px)));
    texts.collect::<Vec<_>>().join(", ")
}

/// The command that draws the picture again, to be run in the directory of the run.
fn command(run: &StressRun, row: &StressRow) -> String {
    let stem = file_name(&format!("{}_{}", row.cause, row.value));
    let method = row.variant.full_name(&row.method);
    format!(
        "svbench render {FAILURES_DIR}/{stem}.toml --method {} --size {}x{}",
        method, run.info.width, run.info.height
    )
}

fn picture(
    run: &StressRun,
    line: &Line<'_>,
    row: &StressRow,
    method: &str,
    album: &Album<'_>,
) -> Result<Markup> {
    let name = row.picture.as_str();
    let path = run.dir.join(FAILURES_DIR).join(name);
    let missing = html! { p.missing { "The picture is missing." } };
    if name.is_empty() {
        return Ok(missing);
    }
    if !album.holds(&name) {
        let address = format!("{FAILURES_DIR}/{name}");
        return Ok(html! { p.missing { a href=(address) { (name) } } });
    }
    let Some(source) = data_uri(&path)? else {
        return Ok(missing);
    };
    let (width, height) = (3 * run.info.width + 2 * GAP_PX, run.info.height);
    // By whole numbers, so that all pixels are of one size.
    let scale = (PAGE_WIDTH_PX / width.max(1)).max(1);
    let alt = format!(
        "{}, {} at {}: truth, shadow mask and errors side by side",
        line.cause.title,
        method,
        short(row.value)
    );
    Ok(html! {
        div.triple style={ "width:" (width * scale) "px" } {
            div.parts aria-hidden="true" { span { "Truth" } span { "Shadow mask" } span { "Errors" } }
            img tabindex="0" loading="lazy" src=(source) alt=(alt) width=(width * scale) height=(height * scale);
        }
    })
}
