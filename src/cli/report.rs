//! `svbench report DIR...`

use crate::config::ConfigError;
use crate::console;
use crate::record::RUN_FILE;
use crate::record::stress::STRESS_FILE;
use std::path::{Path, PathBuf};

/// Arguments of `svbench report`.
#[derive(Debug, clap::Args)]
pub(super) struct ReportArgs {
    /// Run directories; several are merged into one report. Or the directory of one stress run
    #[arg(required = true, value_name = "DIR")]
    dirs: Vec<PathBuf>,
    /// Where a merged report is written: new, empty, or an earlier merged report; needed for several
    /// runs (one run's report goes into its own directory)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Merge runs that differ in size, frames, program version or scale, in columns of their own
    #[arg(long, requires = "out")]
    force: bool,
}

pub(super) fn execute(args: &ReportArgs) -> anyhow::Result<()> {
    let page = match (args.dirs.as_slice(), &args.out) {
        (dirs, out) if dirs.iter().any(|dir| is_stress_run(dir)) => stability(dirs, out.is_some())?,
        (dirs, Some(out)) => crate::report::write_merged(dirs, out, args.force)?,
        ([dir], None) => crate::report::write_all(dir, &super::error_map_legend())?,
        (dirs, None) => {
            return Err(ConfigError(format!(
                "{} runs need a place for their merged report: name one with --out",
                dirs.len()
            ))
            .into());
        }
    };
    console::print(&format!("{}\n", page.display()));
    Ok(())
}

fn is_stress_run(dir: &Path) -> bool {
    dir.join(STRESS_FILE).is_file()
}

/// The report of a stress run, which has nothing in common with those of other runs.
fn stability(dirs: &[PathBuf], has_out: bool) -> anyhow::Result<PathBuf> {
    let stress = dirs.iter().find(|dir| is_stress_run(dir));
    match (dirs, stress) {
        ([dir], _) if dir.join(RUN_FILE).is_file() => Err(ConfigError(format!(
            "{} has both {RUN_FILE} and {STRESS_FILE}: a run and a stress run need directories of their own",
            dir.display()
        ))
        .into()),
        ([dir], _) if !has_out => {
            crate::report::write_stability(dir, &super::error_map_legend())
        }
        (_, stress) => Err(ConfigError(format!(
            "{} holds a stress run, which is not merged with other runs: name it alone and without --out",
            stress.map_or_else(String::new, |dir| dir.display().to_string())
        ))
        .into()),
    }
}
