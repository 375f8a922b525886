//! `svbench run CONFIG`

use super::progress::Progress;
use super::{DeviceArgs, check_size, error_map_legend, reference_cache, values};
use crate::bench::{self, RunRequest};
use crate::config::{Overrides, RunPlan};
use crate::console;
use crate::gpu::Gpu;
use crate::methods::Registry;
use crate::output;
use crate::record::RunStatus;
use crate::record::provenance;
use anyhow::Context;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Arguments of `svbench run`.
#[derive(Debug, clap::Args)]
pub(super) struct RunArgs {
    /// The configuration: a TOML file that names scenes and methods
    config: PathBuf,
    /// The run directory to write, new or empty (default: results/<date>-<time>-<config>-<device>)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Run the configuration at one of its scales: `full`, or one of its `[scales]`
    #[arg(long, value_name = "NAME", default_value = "full")]
    scale: String,
    /// Size of the picture instead of the configuration's
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    size: Option<(u32, u32)>,
    /// Number of measured frames instead of the configuration's
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    frames: Option<u32>,
    /// Run only these methods of the configuration
    #[arg(long, value_name = "METHOD", num_args = 1..)]
    only: Vec<String>,
    #[command(flatten)]
    device: DeviceArgs,
}

pub(super) fn execute(
    args: &RunArgs,
    registry: &Registry,
    accuracy: Option<u32>,
) -> anyhow::Result<()> {
    let mut plan = RunPlan::read(&args.config, &args.scale, registry)?;
    let overrides = Overrides {
        size_px: args.size,
        frames: args.frames,
        accuracy,
        only: args.only.clone(),
    };
    overrides.apply(&mut plan, registry)?;
    let gpu = args.device.open()?;
    let place = match args.size {
        Some(_) => "--size".to_owned(),
        None => format!("{}: size", plan.path),
    };
    check_size(&gpu, plan.size_px, &place)?;
    for (scene, size_px) in plan.scenes.iter().filter_map(|s| Some((s, s.size_px?))) {
        let place = format!("{}: size of `{}`", plan.path, scene.file.name);
        check_size(&gpu, size_px, &place)?;
    }
    let out = match &args.out {
        Some(out) => out.clone(),
        None => default_out(&args.config, &gpu)?,
    };
    let cache = reference_cache()?;
    let progress = Progress::counting("frames")?;
    let outcome = bench::run(&RunRequest {
        gpu: &gpu,
        plan: &plan,
        out: &out,
        command: provenance::command(),
        cache: &cache,
        observer: &progress,
    });
    progress.finish();
    let outcome = outcome?;
    let page = crate::report::write_all(&out, &error_map_legend())?;
    let table = std::fs::read_to_string(out.join(crate::report::TABLE_FILE))?;
    console::print(&format!("{table}\n"));
    for warning in &outcome.warnings {
        console::print(&format!("note: {warning}\n"));
    }
    console::print(&format!("report: {}\n", page.display()));
    args.device.check_validation()?;
    if outcome.status == RunStatus::Interrupted {
        anyhow::bail!("interrupted; what was measured is in {}", out.display());
    }
    match outcome.failed_cells() {
        0 => Ok(()),
        failed => anyhow::bail!(
            "{failed} of {} cells failed; {} has the reasons",
            outcome.summaries.len(),
            page.display()
        ),
    }
}

/// A new directory `results/<date>-<time>-<config>-<device>`, with a number behind it where there is one already.
pub(super) fn default_out(config: &Path, gpu: &Gpu) -> anyhow::Result<PathBuf> {
    const LONGEST: usize = 120;
    let now = jiff::Zoned::now().strftime("%Y-%m-%d-%H%M%S").to_string();
    let config = config.file_stem().unwrap_or_default().to_string_lossy();
    let device: Vec<&str> = gpu.info.name.split_whitespace().take(3).collect();
    let name: String = format!("{now}-{config}-{}", device.join("-"))
        .chars()
        .map(|c| {
            if c.is_ascii_alphanumeric() {
                c.to_ascii_lowercase()
            } else {
                '-'
            }
        })
        .collect();
    let parts: Vec<&str> = name.split('-').filter(|part| !part.is_empty()).collect();
    let mut name = parts.join("-");
    name.truncate(LONGEST);
    let results = Path::new("results");
    output::create_dir_all(results)?;
    let numbered = (2..).map(|number: u32| format!("{name}-{number}"));
    for name in std::iter::once(name.clone()).chain(numbered) {
        let path = results.join(name);
        // Creating it is what makes it this run's.
        match std::fs::create_dir(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            created => {
                return created
                    .map(|()| path.clone())
                    .with_context(|| format!("cannot create {}", path.display()));
            }
        }
    }
    anyhow::bail!("{} is full of runs", results.display())
}
