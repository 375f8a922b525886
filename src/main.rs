//! The `svbench` program: parse, dispatch, report what went wrong.

use clap::Parser;
use std::process::ExitCode;
use svbench::cli::{Cli, exit_code};

#[allow(clippy::print_stderr, reason = "errors go to standard error")]
fn main() -> ExitCode {
    match Cli::parse().execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(exit_code(&error))
        }
    }
}
