//! The `svbench` program: its command line, with the methods that come with it.

use std::process::ExitCode;
use svbench::cli;
use svbench::methods::Registry;

fn main() -> ExitCode {
    cli::main(&Registry::builtin())
}
