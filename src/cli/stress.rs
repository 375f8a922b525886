//! `svbench stress [CONFIG]`

use super::progress::Progress;
use super::run::default_out;
use super::{DeviceArgs, check_size, error_map_legend, values};
use crate::config::ConfigError;
use crate::console;
use crate::gpu::{Gpu, shader};
use crate::judge::Judge;
use crate::judge::Observer;
use crate::methods::Registry;
use crate::record::provenance;
use crate::record::stress::{FAILURES_DIR, FORMAT, Outcome, ROWS_FILE, StressInfo, StressMethod};
use crate::record::{DeviceRecord, HostRecord, file_records};
use crate::report::{self, stability::StressRun};
use crate::stress::{StressPlan, cause_called};
use crate::stress::{StressRequest, sweep};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `svbench stress`.
#[derive(Debug, clap::Args)]
pub(super) struct StressArgs {
    /// The configuration; without one, every method against every cause that comes with the program
    config: Option<PathBuf>,
    /// Try this method instead of the configuration's; may be repeated
    #[arg(long, value_name = "ID[,key=value...]")]
    method: Vec<String>,
    /// Try only this cause; may be repeated
    #[arg(long, value_name = "CAUSE")]
    cause: Vec<String>,
    /// Seed of what is random in the scenes, instead of the configuration's
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Size of the pictures instead of the configuration's
    #[arg(long, value_name = "WxH", value_parser = values::size)]
    size: Option<(u32, u32)>,
    /// The directory to write, new or empty (default: results/<date>-<time>-<config>-<device>)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    device: DeviceArgs,
}

pub(super) fn execute(args: &StressArgs, registry: &Registry) -> anyhow::Result<()> {
    let plan = plan(args, registry)?;
    let gpu = args.device.open()?;
    let place = match args.size {
        Some(_) => "--size".to_owned(),
        None => format!("{}: size", plan.path),
    };
    check_size(&gpu, plan.size_px, &place)?;
    let out = match &args.out {
        Some(out) => out.clone(),
        None => default_out(Path::new(&plan.path), &gpu)?,
    };
    crate::record::new_directory(&out)?;
    let progress = Progress::counting("values")?;
    let started = Instant::now();
    let mut info = info(&plan, &gpu);
    info.write(&out)?;
    let rows = sweep(&StressRequest {
        judge: &Judge::new(&gpu, plan.size_px),
        causes: &plan.causes,
        methods: &plan.methods,
        seed: plan.seed,
        out: &out,
        observer: &progress,
    })?;
    progress.finish();
    info.complete = !progress.interrupted();
    info.duration_s = started.elapsed().as_secs_f64();
    info.files = file_records(&out, &[ROWS_FILE], FAILURES_DIR)?;
    info.write(&out)?;
    let page = report::write_stability(&out, &error_map_legend())?;
    let matrix = StressRun::read(&out)?.matrix_text();
    console::print(&format!("{matrix}\nreport: {}\n", page.display()));
    args.device.check_validation()?;
    if !info.complete {
        anyhow::bail!("interrupted; what was tried is in {}", out.display());
    }
    let count = |outcome| rows.iter().filter(|row| row.outcome == outcome).count();
    match (count(Outcome::Undeclared), count(Outcome::Failed)) {
        (0, 0) => Ok(()),
        (0, failed) => anyhow::bail!(
            "{failed} of {} pictures could not be drawn; {} has the reasons",
            rows.len(),
            page.display()
        ),
        (count, _) => anyhow::bail!(
            "{count} of {} pictures are wrong in a way that no limit of the method declares; {} shows the first of each method and cause",
            rows.len(),
            page.display()
        ),
    }
}

fn plan(args: &StressArgs, registry: &Registry) -> anyhow::Result<StressPlan> {
    let mut plan = match &args.config {
        Some(path) => StressPlan::read(path, registry)?,
        None => StressPlan::builtin(registry)?,
    };
    if !args.method.is_empty() {
        let methods = args.method.iter().map(|method| registry.parse(method));
        plan.methods = methods.collect::<Result<_, _>>()?;
    }
    if !args.cause.is_empty() {
        let causes = args.cause.iter().map(|cause| cause_called(cause));
        plan.causes = causes.collect::<Result<_, ConfigError>>()?;
    }
    plan.check_distinct()?;
    plan.seed = args.seed.unwrap_or(plan.seed);
    plan.size_px = args.size.unwrap_or(plan.size_px);
    Ok(plan)
}

fn info(plan: &StressPlan, gpu: &Gpu) -> StressInfo {
    StressInfo {
        format: FORMAT,
        complete: false,
        title: plan.title.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        program_git: provenance::program_git(),
        started: jiff::Timestamp::now().to_string(),
        duration_s: 0.0,
        command: provenance::command(),
        device: DeviceRecord::of(gpu),
        host: HostRecord::here(),
        seed: plan.seed,
        width: plan.size_px.0,
        height: plan.size_px.1,
        shader_hash: shader::hash(),
        config_path: plan.path.clone(),
        config_text: plan.text.clone(),
        causes: plan.causes.iter().map(|cause| cause.record()).collect(),
        methods: plan
            .methods
            .iter()
            .map(|method| StressMethod::of(method.as_ref()))
            .collect(),
        files: Vec::new(),
    }
}
