//! The page of a stress run: where each method fails, and what that looks like.

use anyhow::Result;
use maud::{Markup, PreEscaped, html};

use super::provenance::Origin;
use super::shell::{self, Section, banner, device_facts, facts_list, program};
use crate::record::stress::{Outcome, StressMethod};
use crate::report::LegendEntry;
use crate::report::format::{date, number_of, short};
use crate::report::stability::{Line, Matrix, StressRun};
use crate::report::table::{Cell, Column, Table};

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
    sections.push(origin(run));
    Ok(shell::page(
        run.title(),
        &facts(run),
        &banners(run, &matrix),
        &sections,
    ))
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
    let corpus = [
        number_of(info.causes.len(), "cause"),
        number_of(scenes, "scene"),
        number_of(info.methods.len(), "method"),
    ];
    facts_list(&[
        device,
        driver,
        ("Tried", format!("{}, in {duration}", date(&info.started))),
        ("Program", program(&info.program_version, &info.program_git)),
        ("Picture", format!("{} × {} px", info.width, info.height)),
        ("Corpus", corpus.join(", ")),
    ])
}

/// What a reader must know before the matrix, the gravest first.
fn banners(run: &StressRun, matrix: &Matrix<'_>) -> Markup {
    let undeclared = run.count(Outcome::Undeclared);
    let mut banners = Vec::new();
    if !run.info.complete {
        let lead = "This run is still going, or was interrupted.";
        banners.push(banner("grave", lead, "What follows is what it left.", &[]));
    }
    if undeclared > 0 {
        let lead = format!("{}.", number_of(undeclared, "undeclared failure"));
        let rest = "A method is wrong where no limit that it declares says so:";
        let methods = matrix.methods.iter().enumerate();
        let methods = methods.filter_map(|(index, method)| undeclared_of(matrix, index, method));
        banners.push(banner("grave", &lead, rest, &methods.collect::<Vec<_>>()));
    } else if run.info.complete && !run.rows.is_empty() {
        let rest = "Wherever a method is wrong, a limit that it declares says so.";
        banners.push(banner("fine", "No undeclared failures.", rest, &[]));
    }
    if run.info.device.is_software() {
        let rest = format!(
            "{} renders on the processor. Where rounding decides, a GPU may fail at other values.",
            run.info.device.name
        );
        banners.push(banner("", "Software device.", &rest, &[]));
    }
    html! { @for banner in banners { (banner) } }
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

fn origin(run: &StressRun) -> Section {
    let info = &run.info;
    let origin = Origin {
        warnings: &run.warnings,
        command: &info.command,
        started: &info.started,
        program_version: &info.program_version,
        program_git: &info.program_git,
        device: &info.device,
        host: &info.host,
        seed: info.seed,
        shader_hash: &info.shader_hash,
        format: info.format,
        config_path: &info.config_path,
        config_text: &info.config_text,
    };
    let columns = [
        Column::heads("Method", "text"),
        Column::text("Parameters that are not at their defaults"),
        Column::number("Tolerated share of wrong pixels"),
    ];
    let methods = info.methods.iter().map(|method| {
        let variant = method.variant.as_str().replace(',', ", ");
        [
            Cell::code(&method.id),
            variant.into(),
            short(method.tolerated_share).into(),
        ]
    });
    let methods = Table::new("Methods", columns).extend(methods);
    origin.section(&html! { h3 { "Methods" } (methods.html()) })
}

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
