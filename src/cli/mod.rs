//! The command line: one subcommand a file, arguments in, calls out.

mod accuracy;
mod advise;
mod earlier;
mod fuzz;
mod interrupt;
mod list;
mod metamorphic;
mod minimise;
mod outputs;
mod profile;
mod progress;
mod render;
mod report;
mod run;
mod shot;
mod stress;
mod values;

use crate::config::ConfigError;
use crate::console;
use crate::gpu::{Gpu, GpuOptions, messages};
use crate::methods::{ParameterError, Registry};
use crate::metrics;
use crate::reference::ReferenceCache;
use crate::report::LegendEntry;
use clap::{Args, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;

/// Exit code for a wrong command line or configuration.
const USAGE: u8 = 2;
/// Exit code for everything else that went wrong.
const FAILED: u8 = 1;

/// A benchmark of hard-shadow algorithms: speed, and accuracy against a ray-traced truth.
#[derive(Debug, Parser)]
#[command(name = "svbench", version, arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Measure and verify what a configuration names, and write a report.
    Run(run::RunArgs),
    /// Like run, but verify every few frames, and measure flicker and visible difference (FLIP) as well.
    Accuracy(accuracy::AccuracyArgs),
    /// Draw one frame with one method, and compare it with the truth.
    Render(render::RenderArgs),
    /// Say what a scene needs: what the plan draws of its shadow volumes, what that saves, and which method to take.
    Advise(advise::AdviseArgs),
    /// Follow the shadows of a day: pictures and hours of sun, by the truth and by methods.
    Profile(profile::ProfileArgs),
    /// Shrink a scene that a method draws wrong to the few triangles that matter.
    Minimise(minimise::MinimiseArgs),
    /// Test methods on known causes of failure, and find where each one first fails.
    Stress(stress::StressArgs),
    /// Test methods on random scenes.
    Fuzz(fuzz::FuzzArgs),
    /// Transform scenes in ways that must not change their shadows, and check that the masks stay the same.
    Metamorphic(metamorphic::MetamorphicArgs),
    /// List methods, scenes, causes of failure and devices.
    List(list::ListArgs),
    /// Write the report of a run again, or merge several runs into one report.
    Report(report::ReportArgs),
}

/// Which device to use.
#[derive(Debug, Args)]
struct DeviceArgs {
    /// Use the graphics adapter whose name contains this text
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Switch the driver's validation layers on; any message of theirs makes the command fail
    #[arg(long)]
    validation: bool,
}

impl DeviceArgs {
    fn open(&self) -> anyhow::Result<Gpu> {
        let options = GpuOptions {
            adapter: self.adapter.clone(),
            validation: self.validation,
            ..GpuOptions::default()
        };
        Ok(Gpu::open(&options)?)
    }

    /// Fails if the validation layers had anything to say.
    fn check_validation(&self) -> anyhow::Result<()> {
        let messages = messages::take_validation_messages();
        if self.validation && !messages.is_empty() {
            anyhow::bail!(
                "the validation layers gave {} messages, see above",
                messages.len()
            );
        }
        Ok(())
    }
}

/// Fails if the device cannot draw pictures of this size; `place` is where the size was given.
fn check_size(gpu: &Gpu, (width, height): (u32, u32), place: &str) -> Result<(), ConfigError> {
    let largest = gpu.max_texture_px();
    if width.max(height) <= largest {
        return Ok(());
    }
    Err(ConfigError(format!(
        "{place}: this device draws at most {largest} × {largest} pixels, not {width} × {height}"
    )))
}

/// The whole program with the methods of `registry`: parses the command line, does what it says, and prints what went
/// wrong.
pub fn main(registry: &Registry) -> ExitCode {
    main_with(std::env::args_os(), registry)
}

/// The same with a command line of the caller's; its first word is the program's name.
pub fn main_with<I>(line: I, registry: &Registry) -> ExitCode
where
    I: IntoIterator<Item: Into<OsString> + Clone>,
{
    let done = match Cli::try_parse_from(line) {
        Ok(cli) => cli.execute(registry),
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

impl Cli {
    /// Does what the command line says, with the methods of `registry`.
    ///
    /// # Errors
    /// Anything that went wrong.
    pub fn execute(self, registry: &Registry) -> anyhow::Result<()> {
        match self.command {
            Command::Run(args) => run::execute(&args, registry, None),
            Command::Accuracy(args) => accuracy::execute(&args, registry),
            Command::Render(args) => render::execute(&args, registry),
            Command::Advise(args) => advise::execute(&args, registry),
            Command::Profile(args) => profile::execute(&args, registry),
            Command::Minimise(args) => minimise::execute(&args, registry),
            Command::Stress(args) => stress::execute(&args, registry),
            Command::Fuzz(args) => fuzz::execute(&args, registry),
            Command::Metamorphic(args) => metamorphic::execute(&args, registry),
            Command::List(args) => list::execute(&args, registry),
            Command::Report(args) => report::execute(&args),
        }
    }
}

/// The exit code of an error: 2 for a wrong command line or configuration, else 1.
fn exit_code(error: &anyhow::Error) -> u8 {
    let usage = error.is::<ConfigError>() || error.is::<ParameterError>();
    if usage { USAGE } else { FAILED }
}

/// Where reference masks are kept: `SVBENCH_CACHE`, else the user's cache folder; an empty
/// variable switches the cache off. `SVBENCH_CACHE_MIB` is what it may grow to.
fn reference_cache() -> anyhow::Result<ReferenceCache> {
    use etcetera::BaseStrategy;
    let dir = match std::env::var_os("SVBENCH_CACHE") {
        Some(dir) if dir.is_empty() => None,
        Some(dir) => Some(dir.into()),
        None => etcetera::choose_base_strategy()
            .ok()
            .map(|dirs| dirs.cache_dir().join("svbench").join("reference")),
    };
    let most_mib = match std::env::var_os("SVBENCH_CACHE_MIB") {
        None => ReferenceCache::DEFAULT_MIB,
        Some(text) => most_mib(&text.to_string_lossy())?,
    };
    Ok(ReferenceCache::open(dir).with_most_bytes(most_mib.saturating_mul(1 << 20)))
}

fn most_mib(text: &str) -> Result<u64, ConfigError> {
    text.trim().parse().map_err(|_| {
        ConfigError(format!(
            "SVBENCH_CACHE_MIB is `{text}`; it must be a whole number of MiB, such as {}",
            ReferenceCache::DEFAULT_MIB
        ))
    })
}

/// What the colours of an error map mean.
fn error_map_legend() -> Vec<LegendEntry> {
    let entry = |label, rgb| LegendEntry { label, rgb };
    vec![
        entry("false lit, artifact", metrics::FALSE_LIT_ARTIFACT_RGB),
        entry(
            "false lit, at the boundary",
            metrics::FALSE_LIT_BOUNDARY_RGB,
        ),
        entry(
            "false shadowed, artifact",
            metrics::FALSE_SHADOWED_ARTIFACT_RGB,
        ),
        entry(
            "false shadowed, at the boundary",
            metrics::FALSE_SHADOWED_BOUNDARY_RGB,
        ),
        entry("ambiguous", metrics::AMBIGUOUS_RGB),
    ]
}
