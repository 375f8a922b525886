//! `svbench fuzz`

use super::progress::Progress;
use super::{DeviceArgs, check_size, values};
use crate::console;
use crate::file_name::method_file_name;
use crate::judge::Judge;
use crate::judge::Observer;
use crate::methods::{Registry, ShadowMethod};
use crate::output;
use crate::record::Image;
use crate::scene::export;
use crate::stress::{Failure, Finding, FuzzPlan, Tally, fuzz};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Random scenes where neither their number nor a time is given.
const DEFAULT_CASES: u64 = 1000;

/// Arguments of `svbench fuzz`.
#[derive(Debug, clap::Args)]
pub(super) struct FuzzArgs {
    /// Try this method; may be repeated (default: every method that promises to be exact)
    #[arg(long, value_name = "ID[,key=value...]")]
    method: Vec<String>,
    /// Number of random scenes (default: 1000, or with --seconds as many as time allows)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    cases: Option<u64>,
    /// Seed of the first scene; the next scene has the next seed
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u64).range(..u64::MAX))]
    seed: u64,
    /// Stop after this many seconds
    #[arg(long, value_name = "S")]
    seconds: Option<u64>,
    /// Size of the pictures
    #[arg(long, value_name = "WxH", value_parser = values::size, default_value = "160x120")]
    size: (u32, u32),
    /// Write every scene with an undeclared failure, and the pictures of errors, into this directory
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceArgs,
}

pub(super) fn execute(args: &FuzzArgs, registry: &Registry) -> anyhow::Result<()> {
    let methods = methods(&args.method, registry)?;
    let gpu = args.device.open()?;
    check_size(&gpu, args.size, "--size")?;
    if let Some(out) = &args.out {
        output::create_dir_all(out)?;
    }
    let progress = Progress::counting("scenes")?;
    let plan = FuzzPlan {
        seeds: seeds(args),
        budget: args.seconds.map(Duration::from_secs),
    };
    let judge = Judge::new(&gpu, args.size);
    let tallies = fuzz(&judge, &methods, &plan, &progress, |failure| {
        progress.print(&format!("{}\n", line(failure, &methods)));
        match &args.out {
            Some(out) => keep(failure, methods[failure.method].as_ref(), out, args.size),
            None => Ok(()),
        }
    })?;
    progress.finish();
    console::print(&table(&methods, &tallies));
    args.device.check_validation()?;
    let undeclared: u64 = tallies.iter().map(|tally| tally.undeclared).sum();
    if undeclared > 0 {
        let pictures = if undeclared == 1 {
            "picture is"
        } else {
            "pictures are"
        };
        anyhow::bail!(
            "{undeclared} {pictures} wrong in a way that no limit of the method declares"
        );
    }
    let failed: u64 = tallies.iter().map(|tally| tally.failed).sum();
    if failed > 0 {
        anyhow::bail!("{failed} pictures could not be drawn; the table has the reasons");
    }
    if progress.interrupted() {
        anyhow::bail!("interrupted");
    }
    let is_idle = |tally: &Tally| tally.cases == 0 && tally.unavailable.is_some();
    if tallies.iter().all(is_idle) {
        anyhow::bail!("no method can draw these scenes on this device");
    }
    console::check_printed()
}

/// The seeds of the scenes: without a number of cases and with a time, all that there are.
fn seeds(args: &FuzzArgs) -> Range<u64> {
    let cases = match (args.cases, args.seconds) {
        (Some(cases), _) => cases,
        (None, None) => DEFAULT_CASES,
        (None, Some(_)) => u64::MAX,
    };
    args.seed..args.seed.saturating_add(cases)
}

/// The methods named, or all that promise to be exact.
fn methods(named: &[String], registry: &Registry) -> anyhow::Result<Vec<Box<dyn ShadowMethod>>> {
    let exact = registry
        .iter()
        .filter(|registration| registration.info.tolerated_share == 0.0)
        .map(|registration| registration.info.id.to_owned());
    let all: Vec<String> = if named.is_empty() {
        exact.collect()
    } else {
        named.to_vec()
    };
    Ok(all
        .iter()
        .map(|text| registry.parse(text))
        .collect::<Result<_, _>>()?)
}

fn line(failure: &Failure<'_>, methods: &[Box<dyn ShadowMethod>]) -> String {
    let Some(drawn) = failure.trial.attempts[failure.method].drawn() else {
        return String::new();
    };
    let judgement = &drawn.judgement;
    let kinds: Vec<_> = judgement
        .analysis
        .label_counts()
        .map(|(word, px)| format!("{px} {word}"))
        .collect();
    format!(
        "seed {}: {}: {} artifact pixels ({}), {}, {} triangles",
        failure.seed,
        methods[failure.method].name(),
        judgement.error.artifact_px,
        kinds.join(", "),
        failure.finding.word(),
        failure.scene.mesh.triangles.len(),
    )
}

fn keep(
    failure: &Failure<'_>,
    method: &dyn ShadowMethod,
    out: &Path,
    size_px: (u32, u32),
) -> anyhow::Result<()> {
    if !matches!(failure.finding, Finding::Undeclared) {
        return Ok(());
    }
    let stem = &failure.scene.name;
    export::write(failure.scene, out, stem)?;
    let method = method_file_name(method.info().id, &method.variant());
    match failure.trial.attempts[failure.method].drawn() {
        Some(drawn) => Image::rgb(size_px, &drawn.judgement.error_map)
            .write_png(&out.join(format!("{stem}_{method}.png"))),
        None => Ok(()),
    }
}

fn table(methods: &[Box<dyn ShadowMethod>], tallies: &[Tally]) -> String {
    let mut text = String::from(
        "   cases  undeclared  declared  artifact px  boundary px  ambiguous px  method\n",
    );
    for (method, tally) in methods.iter().zip(tallies) {
        text.push_str(&format!(
            "{:8}  {:10}  {:8}  {:11}  {:11}  {:12}  {}\n",
            tally.cases,
            tally.undeclared,
            tally.declared,
            tally.error.artifact_px,
            tally.error.boundary_px,
            tally.error.ambiguous_px,
            method.name(),
        ));
        if let Some(reason) = &tally.unavailable {
            text.push_str(&format!("          not available: {reason}\n"));
        }
        if let Some(failure) = &tally.failure {
            let failed = tally.failed;
            text.push_str(&format!(
                "          {failed} not drawn, the last: {failure}\n"
            ));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        fuzz: FuzzArgs,
    }

    #[test]
    fn time_alone_ends_a_run_unless_a_number_of_cases_is_given_too() {
        let seeds = |words: &[&str]| {
            let words = ["fuzz", "--seed", "7"].iter().chain(words);
            seeds(&Line::try_parse_from(words).unwrap().fuzz)
        };
        assert_eq!(seeds(&[]), 7..1007);
        assert_eq!(seeds(&["--cases", "3"]), 7..10);
        assert_eq!(seeds(&["--seconds", "60", "--cases", "3"]), 7..10);
        assert_eq!(seeds(&["--seconds", "60"]), 7..u64::MAX);
    }
}
