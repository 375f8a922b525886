//! A whole run, scene after scene.

use super::Watched;
use super::executor::Executor;
use super::on_gpu::OnGpu;
use super::scene_run::{SceneOutcome, run_scene};
use crate::config::RunPlan;
use crate::gpu::{Gpu, shader};
use crate::judge::Observer;
use crate::memory;
use crate::record::RunDirError;
use crate::record::provenance::program_git;
use crate::record::run_dir::RunDir;
use crate::record::{
    DeviceRecord, FORMAT, HostRecord, MethodRecord, RunInfo, RunStatus, Status, Summary,
};
use crate::reference::ReferenceCache;
use std::path::Path;

/// What to run, where, and who watches.
pub struct RunRequest<'a> {
    /// The device; where it is lost, the run goes on with the same one opened again.
    pub gpu: &'a Gpu,
    /// What to measure.
    pub plan: &'a RunPlan,
    /// The run directory, new or empty.
    pub out: &'a Path,
    /// The command line, for provenance.
    pub command: Vec<String>,
    /// Where reference masks are kept.
    pub cache: &'a ReferenceCache,
    /// Told of progress.
    pub observer: &'a dyn Observer,
}

/// How a run ended.
pub struct RunOutcome {
    /// Complete or interrupted.
    pub status: RunStatus,
    /// A row a cell.
    pub summaries: Vec<Summary>,
    /// What to know before trusting a number, as in `run.json`.
    pub warnings: Vec<String>,
}

impl RunOutcome {
    /// Cells that failed.
    pub fn failed_cells(&self) -> usize {
        self.summaries
            .iter()
            .filter(|summary| summary.status == Status::Failed)
            .count()
    }
}

/// Runs the plan and leaves a run directory. Cells that cannot run are recorded with the reason.
///
/// # Errors
/// When the directory cannot be written; what was measured stays. A device that is lost is opened again.
pub fn run(request: &RunRequest<'_>) -> anyhow::Result<RunOutcome> {
    let mut dir = RunDir::create(request.out)?;
    let mut info = info(request);
    dir.write_info(&info).map_err(RunDirError::into_inner)?;
    request
        .observer
        .begin(request.plan.steps_per_scene() * request.plan.scenes.len() as u64);
    let mut summaries = Vec::new();
    let mut device = OnGpu {
        gpu: request.gpu.clone(),
        plan: request.plan,
        cache: request.cache,
    };
    let watched = Watched {
        plan: request.plan,
        observer: request.observer,
    };
    let done = run_scenes(watched, &mut device, &mut dir, &mut info, &mut summaries);
    if let Err(error) = done {
        info.status = RunStatus::Failed;
        // What failed first is what is told; the rest is kept as far as it can be.
        let _ = dir.write_summary(&summaries);
        info.files = dir.file_records().unwrap_or_default();
        if dir.write_info(&info).is_err() {
            dir.mark_failed();
        }
        return Err(error);
    }
    Ok(RunOutcome {
        status: info.status,
        summaries,
        warnings: info.warnings,
    })
}

/// Runs the scenes and closes the run, unless a file cannot be written.
pub(super) fn run_scenes(
    watched: Watched<'_>,
    executor: &mut dyn Executor,
    dir: &mut RunDir,
    info: &mut RunInfo,
    summaries: &mut Vec<Summary>,
) -> anyhow::Result<()> {
    let Watched { plan, observer } = watched;
    for scene in &plan.scenes {
        if observer.interrupted() {
            break;
        }
        let outcome = run_scene(watched, executor, scene, dir);
        let in_scene = |error: RunDirError| {
            let place = format!("scene `{}`", scene.file.name);
            error.into_inner().context(place)
        };
        let SceneOutcome {
            record,
            methods,
            summaries: rows,
            warnings,
        } = outcome.map_err(in_scene)?;
        info.scenes.push(record);
        info.warnings.extend(warnings);
        add_methods(&mut info.methods, methods);
        summaries.extend(rows);
        let written = dir.write_summary(summaries);
        written
            .and_then(|()| dir.write_info(info))
            .map_err(in_scene)?;
    }
    info.status = match observer.interrupted() {
        true => RunStatus::Interrupted,
        false => RunStatus::Complete,
    };
    let mut close = || {
        dir.write_summary(summaries)?;
        info.peak_memory_bytes = memory::peak_bytes();
        info.files = dir.file_records()?;
        dir.write_info(info)
    };
    close().map_err(RunDirError::into_inner)
}

/// A method's stages are known once a scene has drawn it.
fn add_methods(known: &mut Vec<MethodRecord>, found: Vec<MethodRecord>) {
    for method in found {
        match known
            .iter_mut()
            .find(|m| m.id == method.id && m.variant == method.variant)
        {
            Some(seen) if seen.stages.is_empty() => seen.stages = method.stages,
            Some(_) => {}
            None => known.push(method),
        }
    }
}

fn info(request: &RunRequest<'_>) -> RunInfo {
    let RunRequest { gpu, plan, .. } = request;
    RunInfo {
        format: FORMAT,
        status: RunStatus::Running,
        title: plan.title.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        program_git: program_git(),
        started: jiff::Timestamp::now().to_string(),
        command: request.command.clone(),
        device: DeviceRecord::of(gpu),
        host: HostRecord::here(),
        seed: plan.seed,
        width: plan.size_px.0,
        height: plan.size_px.1,
        frames: plan.frames,
        warmup_frames: plan.warmup_frames,
        lead_in: plan.lead_in,
        verified_frames: plan.verified_frames(),
        scenes: Vec::new(),
        methods: Vec::new(),
        shader_hash: shader::hash(),
        config_path: plan.path.clone(),
        config_text: plan.text.clone(),
        scale: plan.scale.clone(),
        peak_memory_bytes: None,
        warnings: Vec::new(),
        files: Vec::new(),
    }
}
