//! The page of a stress run: where each method fails, and what that looks like.

use super::{Fact, date, device_facts, facts_list, program, provenance, shell};
use crate::record::stress::StressMethod;
use crate::report::LegendEntry;
use crate::report::format::{count, short};
use crate::report::stability::{Failure, Line, Matrix, StressRun};
use anyhow::Result;
use maud::{Markup, PreEscaped, html};

mod causes;
mod failures;
mod limits;
mod matrix;

/// The page of a stress run. Pictures are read from its directory; one that is missing is said to be.
pub(in crate::report) fn page(run: &StressRun, legend: &[LegendEntry]) -> Result<String> {
    let matrix = run.matrix();
    let limits = limits::section(run);
    let mut links = vec![("matrix", "Where methods fail"), ("causes", "Causes")];
    links.extend(limits.is_some().then_some(("limits", "Limits")));
    links.push(("provenance", "Provenance"));
    let main = html! {
        (banners(run, &matrix))
        (matrix::section(&matrix))
        (causes::section(run, &matrix, legend)?)
        @if let Some(limits) = limits { (limits) }
        (origin(run))
    };
    Ok(shell(run.title(), &facts(run), &links, &main))
}

fn facts(run: &StressRun) -> Markup {
    let info = &run.info;
    let [device, driver] = device_facts(&info.device);
    let minutes = info.duration_s / 60.0;
    let duration = if minutes < 1.0 {
        format!("{:.0} s", info.duration_s)
    } else {
        format!("{minutes:.0} min")
    };
    let scenes: usize = info.causes.iter().map(|cause| cause.values.len()).sum();
    let facts: [Fact; 6] = [
        device,
        driver,
        ("Tried", format!("{}, in {duration}", date(&info.started))),
        ("Program", program(&info.program_version, &info.program_git)),
        ("Picture", format!("{} × {} px", info.width, info.height)),
        (
            "Corpus",
            format!(
                "{}, {}, {}",
                some(info.causes.len(), "cause"),
                some(scenes, "scene"),
                some(info.methods.len(), "method")
            ),
        ),
    ];
    facts_list(&facts)
}

/// A number of things.
fn some(number: usize, what: &str) -> String {
    let plural = if number == 1 { "" } else { "s" };
    format!("{} {what}{plural}", count(number as u64))
}

/// What a reader must know before the matrix, the gravest first.
fn banners(run: &StressRun, matrix: &Matrix<'_>) -> Markup {
    let undeclared = run.undeclared();
    html! {
        @if !run.info.complete {
            div.banner.grave role="note" {
                p {
                    strong { "This run is still going, or was interrupted." }
                    " What follows is what it left."
                }
            }
        }
        @if undeclared > 0 {
            div.banner.grave role="note" {
                p {
                    strong { (some(undeclared, "undeclared failure")) "." }
                    " A method is wrong where no limit that it declares says so:"
                }
                ul {
                    @for (index, method) in matrix.methods.iter().enumerate() {
                        (undeclared_of(matrix, index, method))
                    }
                }
            }
        } @else if run.info.complete && !run.rows.is_empty() {
            div.banner.fine role="note" {
                p {
                    strong { "No undeclared failures." }
                    " Wherever a method is wrong, a limit that it declares says so."
                }
            }
        }
        @if run.info.device.is_software() {
            div.banner role="note" {
                p {
                    strong { "Software device." }
                    " " (run.info.device.name) " renders on the processor. Where rounding decides, "
                    "a GPU may fail at other values."
                }
            }
        }
    }
}

/// The causes that bring a method down undeclared, with the first such value.
fn undeclared_of(matrix: &Matrix<'_>, index: usize, method: &StressMethod) -> Markup {
    let found: Vec<_> = matrix
        .lines
        .iter()
        .filter_map(|line| {
            let row = line.cells[index].failure()?.undeclared?;
            Some((line, short(row.value)))
        })
        .collect();
    html! {
        @if !found.is_empty() {
            li {
                code { (method.name()) } ": "
                @for (place, (line, value)) in found.iter().enumerate() {
                    @if place > 0 { ", " }
                    a href={ "#" (failure_id(line, index)) } { (line.cause.id) " at " (value) }
                }
            }
        }
    }
}

fn origin(run: &StressRun) -> Markup {
    let info = &run.info;
    let origin = provenance::Origin {
        command: &info.command,
        started: &info.started,
        program_version: &info.program_version,
        program_git: &info.program_git,
        device: &info.device,
        host: &info.host,
        seed: info.seed,
        shader_hash: &info.shader_hash,
        format: info.format,
    };
    html! {
        section #provenance {
            h2 { "Provenance" }
            (provenance::warnings(&run.warnings))
            (provenance::settings(&origin))
            h3 { "Methods" }
            (methods(&info.methods))
            (provenance::configuration(&info.config_path, &info.config_text))
        }
    }
}

fn methods(methods: &[StressMethod]) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Methods" {
            table {
                thead {
                    tr {
                        th.text scope="col" { "Method" }
                        th.text scope="col" { "Parameters that are not at their defaults" }
                        th scope="col" { "Tolerated share of wrong pixels" }
                    }
                }
                tbody {
                    @for method in methods {
                        tr {
                            th.text scope="row" { code { (method.id) } }
                            td.text { (method.variant.as_str().replace(',', ", ")) }
                            td { (short(method.tolerated_share)) }
                        }
                    }
                }
            }
        }
    }
}

/// The id of a cause's section.
fn cause_id(line: &Line<'_>) -> String {
    format!("cause-{}", line.cause.id)
}

/// The id of a method's first failure, in the section of the cause; `method` is the method's place.
fn failure_id(line: &Line<'_>, method: usize) -> String {
    format!("cause-{}-{}", line.cause.id, method + 1)
}

/// Text that may break after an underscore and an equals sign, so that columns stay narrow.
fn breakable(name: &str) -> Markup {
    html! {
        @for part in name.split_inclusive(['_', '=']) {
            (part)
            @if part.ends_with(['_', '=']) { (PreEscaped("<wbr>")) }
        }
    }
}

/// The value at which a failure begins, marked if no limit declares it.
fn first_value(failure: &Failure<'_>) -> String {
    let mark = if failure.begins_undeclared() { "!" } else { "" };
    format!("{}{mark}", short(failure.first.value))
}
