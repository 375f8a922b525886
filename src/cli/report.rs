//! `svbench report DIR...`

use crate::config::ConfigError;
use std::path::PathBuf;

/// Arguments of `svbench report`.
#[derive(Debug, clap::Args)]
pub(super) struct ReportArgs {
    /// Run directories; several are merged into one report
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

#[allow(
    clippy::print_stdout,
    reason = "the path of the report is this command's result"
)]
pub(super) fn execute(args: &ReportArgs) -> anyhow::Result<()> {
    let page = match (args.dirs.as_slice(), &args.out) {
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
    println!("{}", page.display());
    Ok(())
}
