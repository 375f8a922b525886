//! The `svbench` program: parse, dispatch, report what went wrong.

use clap::Parser;
use std::process::ExitCode;
use svbench::cli::{Cli, exit_code};
use svbench::console;

fn main() -> ExitCode {
    let done = match Cli::try_parse() {
        Ok(cli) => cli.execute(),
        // Help is what was asked for, or else what is wrong with the command line.
        Err(help) if help.use_stderr() => {
            let _ = help.print();
            return u8::try_from(help.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from);
        }
        Err(help) => {
            console::note(help.print());
            console::check_printed()
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            console::say(&format!("error: {error:#}"));
            ExitCode::from(exit_code(&error))
        }
    }
}
