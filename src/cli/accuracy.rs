//! `svbench accuracy CONFIG`

use super::run::{self, RunArgs};
use crate::methods::Registry;

/// Arguments of `svbench accuracy`.
#[derive(Debug, clap::Args)]
pub(super) struct AccuracyArgs {
    #[command(flatten)]
    run: RunArgs,
    /// Compare every N-th measured frame with the truth, instead of what the configuration says
    #[arg(long, value_name = "N", default_value_t = 4)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
}

pub(super) fn execute(args: &AccuracyArgs, registry: &Registry) -> anyhow::Result<()> {
    run::execute(&args.run, registry, Some(args.every))
}
