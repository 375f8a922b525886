//! The order of the house, read from its sources: which folder may import which, where `unsafe` may stand, how
//! long files and functions may be.
//!
//! Each test prints everything that it finds. What is known to be wrong and waits to be mended is in a list
//! beside its test; a list that names more than there is fails too, so that it can only shrink.
#![allow(clippy::unwrap_used, reason = "tests")]

mod circles;
mod imports;
mod sources;

use imports::Import;
use sources::{Source, sources};
use std::collections::BTreeSet;

/// From the user down to the device: a folder imports only what stands below it. Behind the last come the files
/// of the root, which import no folder.
const FLOORS: [&str; 16] = [
    "cli",
    "advise",
    "profile",
    "report",
    "stress",
    "bench",
    "judge",
    "record",
    "config",
    "methods",
    "frame",
    "metrics",
    "reference",
    "geometry",
    "scene",
    "gpu",
];

/// Imports that run up a floor: `(importing folder, imported folder)`.
const KNOWN_UPWARD: &[(&str, &str)] = &[];

/// Circles: the folder, and the files and folders in it that import each other.
const KNOWN_CIRCLES: &[&str] = &[];

/// Functions that are too long.
const KNOWN_LONG_FUNCTIONS: &[&str] = &[];

/// What the ninetieth percentile of the files and the report have now, where that is more than they may.
const KNOWN_FILE_LINES: Option<usize> = None;
const KNOWN_REPORT_LINES: Option<usize> = Some(6800);

const MAX_FILE_LINES: usize = 250;
const MAX_FUNCTION_LINES: usize = 60;
const MAX_REPORT_LINES: usize = 5300;

/// Fails on what was found and is not known, and on what is known and was not found. `found` has the name that the
/// list of the known gives it, and the words.
fn check<'a>(what: &str, found: &[(String, String)], known: impl Iterator<Item = String> + 'a) {
    let known: BTreeSet<_> = known.collect();
    let names: BTreeSet<_> = found.iter().map(|(name, _)| name.clone()).collect();
    let new = found.iter().filter(|(name, _)| !known.contains(name));
    let mut complaints: Vec<_> = new
        .map(|(name, words)| format!("{name}: {words}"))
        .collect();
    complaints.extend(
        known
            .difference(&names)
            .map(|name| format!("{name}: mended; take it out of the list of what is known")),
    );
    assert!(
        complaints.is_empty(),
        "{what}:\n{}\n",
        complaints.join("\n")
    );
}

/// Fails on more lines than allowed or known, and on a known length that is no longer needed.
fn check_lines(what: &str, lines: usize, max: usize, known: Option<usize>) {
    assert!(
        lines <= known.unwrap_or(max),
        "{what}: {lines} lines, more than {}",
        known.unwrap_or(max)
    );
    let is_mended = known.is_some() && lines <= max;
    assert!(
        !is_mended,
        "{what}: {lines} lines are no more than {max}; set what is known to None"
    );
}

/// The floor of a module: 0 is the device, below it are the files of the root.
fn floor(path: &[String]) -> Option<usize> {
    let name = path.first()?;
    FLOORS.iter().rev().position(|floor| floor == name)
}

#[test]
fn no_import_runs_up_a_floor() {
    let sources = sources();
    let upward = |import: &Import| {
        // `lib.rs` and `main.rs` are the roof.
        let from = import.from.first()?;
        let (up, down) = (floor(&import.from), floor(&import.named));
        let is_upward = down.is_some() && from != import.named.first()? && up < down;
        is_upward.then(|| (format!("{from} → {}", import.named[0]), import.to_string()))
    };
    let found: Vec<_> = imports::all(&sources).iter().filter_map(upward).collect();
    let known = KNOWN_UPWARD
        .iter()
        .map(|(from, to)| format!("{from} → {to}"));
    check("imports that run up a floor", &found, known);
}

#[test]
fn every_folder_has_a_floor() {
    let folders: BTreeSet<_> = sources::folders();
    assert_eq!(
        folders,
        FLOORS.map(str::to_owned).into(),
        "folders of src, floors of this test"
    );
}

#[test]
fn no_two_modules_of_a_folder_import_each_other() {
    let sources = sources();
    let found = circles::circles(&imports::all(&sources));
    let known = KNOWN_CIRCLES.iter().map(|&name| name.to_owned());
    check(
        "circles between files or folders of one folder",
        &found,
        known,
    );
}

#[test]
fn unsafe_code_is_near_the_device() {
    let sources = sources();
    let outside = sources
        .iter()
        .filter(|source| source.module.first().is_none_or(|name| name != "gpu"));
    let found: Vec<_> = outside.flat_map(Source::unsafe_lines).collect();
    assert!(
        found.is_empty(),
        "unsafe outside of src/gpu:\n{}\n",
        found.join("\n")
    );
}

#[test]
fn functions_are_short() {
    let long = |source: &Source| {
        let functions = source.functions().into_iter();
        let too_long = functions.filter(|function| function.lines > MAX_FUNCTION_LINES);
        let named = too_long.map(|function| {
            let name = format!("{}::{}", source.module.join("::"), function.name);
            (
                name,
                format!(
                    "{} lines, {}:{}",
                    function.lines, source.file, function.line
                ),
            )
        });
        named.collect::<Vec<_>>()
    };
    let found: Vec<_> = sources().iter().flat_map(long).collect();
    let known = KNOWN_LONG_FUNCTIONS.iter().map(|&name| name.to_owned());
    check("functions of more than 60 lines", &found, known);
}

#[test]
fn files_are_short() {
    let mut lengths: Vec<_> = sources::all_files()
        .into_iter()
        .map(|(file, text)| (text.lines().count(), file))
        .collect();
    lengths.sort();
    let (length, _) = lengths[lengths.len() * 9 / 10];
    let longest: Vec<_> = lengths
        .iter()
        .rev()
        .take(30)
        .map(|(lines, file)| format!("{lines:5} {file}"))
        .collect();
    let what = format!(
        "the ninetieth percentile of the files, of which the longest are\n{}\n",
        longest.join("\n")
    );
    check_lines(&what, length, MAX_FILE_LINES, KNOWN_FILE_LINES);
}

#[test]
fn the_report_is_no_longer_than_it_needs() {
    let sources = sources();
    let report = sources
        .iter()
        .filter(|source| source.module.first().is_some_and(|name| name == "report"));
    let lines: usize = report.map(|source| source.code_lines()).sum();
    check_lines(
        "src/report without its tests",
        lines,
        MAX_REPORT_LINES,
        KNOWN_REPORT_LINES,
    );
}
