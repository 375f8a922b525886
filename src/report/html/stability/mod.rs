//! The page of a stress run: where each method fails, and what that looks like.

use anyhow::Result;
use maud::{Markup, html};

use super::provenance;
use super::shell::{self, Section, banner};
use crate::record::RunInfo;
use crate::record::stress::{Outcome, StressMethod};
use crate::report::LegendEntry;
use crate::report::format::{date, number_of, short};
use crate::report::stability::{Line, Matrix, StressRun};
use crate::report::table::{Cell, Column, Part, Table};

mod causes;
mod failures;
mod limits;
mod matrix;

/// The page of a stress run. Pictures are read from its directory; one that is missing is said to be.
pub(in crate::report) fn page(run: &StressRun, legend: &[LegendEntry]) -> Result<String> {
    let matrix = run.matrix();
    let mut sections = vec![
        matrix::section(&matrix),
        causes::section(run, &matrix, legend)?,
    ];
    sections.extend(limits::section(run));
    let info = common(run);
    sections.push(origin(run, &info));
    let facts = facts(run, &info);
    let banners = banners(run, &matrix);
    Ok(shell::page(run.title(), &facts, &banners, &sections))
}

/// What it says of itself in the words of other runs.
fn common(run: &StressRun) -> RunInfo {
    let info = run.info.clone();
    RunInfo {
        format: info.format,
        program_version: info.program_version,
        program_git: info.program_git,
        started: info.started,
        command: info.command,
        device: info.device,
        host: info.host,
        seed: info.seed,
        width: info.width,
        height: info.height,
        shader_hash: info.shader_hash,
        config_path: info.config_path,
        config_text: info.config_text,
        ..RunInfo::default()
    }
}

fn facts(run: &StressRun, common: &RunInfo) -> Markup {
    let info = &run.info;
    let duration = match info.duration_s / 60.0 {
        ..1.0 => format!("{:.0} s", info.duration_s),
        minutes => format!("{minutes:.0} min"),
    };
    let tried = format!("{}, in {duration}", date(&info.started));
    let scenes = info.causes.iter().map(|cause| cause.values.len()).sum();
    let corpus = [
        number_of(info.causes.len(), "cause"),
        number_of(scenes, "scene"),
        number_of(info.methods.len(), "method"),
    ];
    provenance::facts(common, ("Tried", tried), ("Corpus", corpus.join(", ")))
}

/// What a reader must know before the matrix, the gravest first.
fn banners(run: &StressRun, matrix: &Matrix<'_>) -> Markup {
    let undeclared = run.count(Outcome::Undeclared);
    let methods = matrix.methods.iter().enumerate();
    let methods = methods.filter_map(|(index, method)| undeclared_of(matrix, index, method));
    html! {
        @if !run.info.complete {
            (banner("grave", "This run is still going, or was interrupted.", "What follows is what it left.", &[]))
        }
        @if undeclared > 0 {
            @let lead = format!("{}.", number_of(undeclared, "undeclared failure"));
            @let rest = "A method is wrong where no limit that it declares says so:";
            (banner("grave", &lead, rest, &methods.collect::<Vec<_>>()))
        } @else if run.info.complete && !run.rows.is_empty() {
            @let rest = "Wherever a method is wrong, a limit that it declares says so.";
            (banner("fine", "No undeclared failures.", rest, &[]))
        }
        @if run.info.device.is_software() {
            @let rest = "renders on the processor. Where rounding decides, a GPU may fail at other values.";
            (banner("", "Software device.", &format!("{} {rest}", run.info.device.name), &[]))
        }
    }
}

/// The causes that bring a method down undeclared, with the first such value.
fn undeclared_of(matrix: &Matrix<'_>, index: usize, method: &StressMethod) -> Option<Markup> {
    let found = matrix.lines.iter().filter_map(|line| {
        let row = line.cells[index].failure()?.undeclared?;
        Some((line, short(row.value)))
    });
    let found: Vec<(&Line<'_>, String)> = found.collect();
    let list = html! {
        code { (method.name()) } ": "
        @for (place, (line, value)) in found.iter().enumerate() {
            @if place > 0 { ", " }
            a href={ "#" (failure_id(line, index)) } { (line.cause.id) " at " (value) }
        }
    };
    (!found.is_empty()).then_some(list)
}

fn origin(run: &StressRun, common: &RunInfo) -> Section {
    let variant = "Parameters that are not at their defaults";
    let tolerated = "Tolerated share of wrong pixels";
    let methods = Table::of("Methods", &run.info.methods)
        .column(Column::heads("Method", ""), |of| Cell::code(&of.id))
        .text(variant, |of| of.variant.as_str().replace(',', ", "))
        .number(tolerated, |method| short(method.tolerated_share));
    let methods = html! { h3 { "Methods" } (methods.html()) };
    provenance::of(common, &run.warnings, &methods)
}

fn cause_link(id: &str) -> Part {
    Part::Link(format!("cause-{id}"), id.to_owned())
}

/// The id of a method's first failure, in the section of the cause; `method` is the method's place.
fn failure_id(line: &Line<'_>, method: usize) -> String {
    format!("cause-{}-{}", line.cause.id, method + 1)
}
