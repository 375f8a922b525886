//! `svbench report DIR`

use std::path::PathBuf;

/// Arguments of `svbench report`.
#[derive(Debug, clap::Args)]
pub(super) struct ReportArgs {
    /// A run directory
    dir: PathBuf,
}

#[allow(
    clippy::print_stdout,
    reason = "the path of the report is this command's result"
)]
pub(super) fn execute(args: &ReportArgs) -> anyhow::Result<()> {
    let page = crate::report::write_all(&args.dir, &super::error_map_legend())?;
    println!("{}", page.display());
    Ok(())
}
