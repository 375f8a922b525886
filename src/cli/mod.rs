//! The command line: one subcommand a file, arguments in, calls out.

mod accuracy;
mod earlier;
mod fuzz;
mod interrupt;
mod list;
mod metamorphic;
mod minimise;
mod outputs;
mod progress;
mod render;
mod report;
mod run;
mod shot;
mod stress;
mod values;

use crate::config::ConfigError;
use crate::gpu::{Gpu, GpuOptions, messages};
use crate::methods::ParameterError;
use crate::metrics;
use crate::reference::ReferenceCache;
use crate::report::LegendEntry;
use clap::{Args, Parser, Subcommand};

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
    /// As run, but verify every few frames, and look for flicker and visible difference too.
    Accuracy(accuracy::AccuracyArgs),
    /// Draw one frame with one method, and compare it with the truth.
    Render(render::RenderArgs),
    /// Shrink a scene that a method draws wrong to the few triangles that matter.
    Minimise(minimise::MinimiseArgs),
    /// Try methods on causes of failure, and say where each fails first.
    Stress(stress::StressArgs),
    /// Try methods on random scenes.
    Fuzz(fuzz::FuzzArgs),
    /// Change scenes in ways that do not change their shadow, and look whether a mask changes.
    Metamorphic(metamorphic::MetamorphicArgs),
    /// List methods, scenes, causes of failure and devices.
    List(list::ListArgs),
    /// Write the report of a run directory again, or one of several runs together.
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

impl Cli {
    /// Does what the command line says.
    ///
    /// # Errors
    /// Anything that went wrong; [`exit_code`] tells what that means for the shell.
    pub fn execute(self) -> anyhow::Result<()> {
        match self.command {
            Command::Run(args) => run::execute(&args, None),
            Command::Accuracy(args) => accuracy::execute(&args),
            Command::Render(args) => render::execute(&args),
            Command::Minimise(args) => minimise::execute(&args),
            Command::Stress(args) => stress::execute(&args),
            Command::Fuzz(args) => fuzz::execute(&args),
            Command::Metamorphic(args) => metamorphic::execute(&args),
            Command::List(args) => list::execute(&args),
            Command::Report(args) => report::execute(&args),
        }
    }
}

/// The exit code of an error: 2 for a wrong command line or configuration, else 1.
pub fn exit_code(error: &anyhow::Error) -> u8 {
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
