//! One scene of a run: prepare every method, verify, measure, sum up.

use super::cell::{CellRun, name_cell};
use super::fault::Broken;
use super::measure::{Schedule, measure};
use super::preparation::Preparation;
use super::verify_cells::verify_cells;
use super::{RunRequest, bias_search};
use crate::config::{MethodPlan, ScenePlan};
use crate::frame::{FrameResources, SceneBuffers};
use crate::gpu::Gpu;
use crate::judge::Verifier;
use crate::methods::PrepareContext;
use crate::metrics;
use crate::record::run_dir::RunDir;
use crate::record::{EdgeRecord, MethodRecord, SceneRecord, Status, Summary};
use crate::record::{RunDirError, in_one_line};
use crate::scene::file::MeshSource;
use crate::scene::{FrameError, Scene, SceneError};
use anyhow::Context;

/// What a scene's part of the run came to.
pub(super) struct SceneOutcome {
    pub record: SceneRecord,
    pub methods: Vec<MethodRecord>,
    pub summaries: Vec<Summary>,
    pub warnings: Vec<String>,
}

/// Runs one scene on `gpu`, which is opened again where it is lost. What concerns the scene or one of its
/// cells becomes their status; only what concerns the run directory is an error.
pub(super) fn run_scene(
    request: &RunRequest<'_>,
    gpu: &mut Gpu,
    plan: &ScenePlan,
    dir: &mut RunDir,
) -> Result<SceneOutcome, RunDirError> {
    request
        .observer
        .phase(&format!("{}: loading", plan.file.name));
    let scene = match load(gpu, plan) {
        Ok(scene) => scene,
        Err(error) => {
            request.observer.advance(request.plan.steps_per_scene());
            return Ok(not_loaded(request, plan, &error));
        }
    };
    let mut run = SceneRun::new(request, &scene);
    match check_views(request, &scene) {
        Ok(()) => run.on_devices(gpu, dir)?,
        Err(error) => {
            request.observer.advance(request.plan.steps_per_scene());
            run.fail(&error.into());
        }
    }
    Ok(run.outcome())
}

fn load(gpu: &Gpu, plan: &ScenePlan) -> anyhow::Result<Scene> {
    // A grid that the device cannot take need not be built first.
    if let MeshSource::SphereGrid(grid) = &plan.file.mesh {
        SceneBuffers::check(gpu, grid.triangle_count())?;
    }
    Ok(plan.file.load(&plan.search)?)
}

fn not_loaded(request: &RunRequest<'_>, plan: &ScenePlan, error: &anyhow::Error) -> SceneOutcome {
    let status = match error.downcast_ref() {
        Some(SceneError::MissingModel { .. }) => Status::Skipped,
        _ => Status::Failed,
    };
    // With its causes: a scene's own error may not say which line of its model is at fault.
    let reason = in_one_line(error);
    let summary = |method: &MethodPlan| {
        let size_px = request.plan.size_px;
        let cell = name_cell(&plan.file.name, method.method.as_ref(), size_px);
        Summary::from_samples(&cell, &[], &[], status, &reason)
    };
    SceneOutcome {
        summaries: request.plan.methods.iter().map(summary).collect(),
        record: SceneRecord {
            name: plan.file.name.clone(),
            title: plan.file.title.clone(),
            triangles: None,
            objects: None,
            mesh_hash: String::new(),
            light: [0.0; 3],
            light_w: 0.0,
            light_moves: false,
            edges: None,
            status,
            reason,
        },
        methods: Vec::new(),
        warnings: Vec::new(),
    }
}

/// Looks at every view of the flight that the run will draw: nothing is measured of a flight that has frames
/// without a picture.
fn check_views(request: &RunRequest<'_>, scene: &Scene) -> Result<(), FrameError> {
    let (plan, flight) = (request.plan, &scene.flight);
    let measured_s = flight.frame_times(plan.frames as usize);
    let mut verified_s = plan.verified_times(flight);
    if plan
        .methods
        .iter()
        .any(|plan| plan.method.bias_search().is_some())
    {
        verified_s.extend(bias_search::times(plan, flight));
    }
    flight.check_times(measured_s.into_iter().chain(verified_s))
}

/// A scene that is being run.
struct SceneRun<'a> {
    request: &'a RunRequest<'a>,
    scene: &'a Scene,
    cells: Vec<CellRun<'a>>,
    edges: Option<EdgeRecord>,
    /// Why nothing of it goes on, if that is so.
    failure: Option<String>,
    warnings: Vec<String>,
}

impl<'a> SceneRun<'a> {
    fn new(request: &'a RunRequest<'a>, scene: &'a Scene) -> Self {
        let cell = |plan| CellRun::new(plan, scene, request.plan.size_px);
        Self {
            request,
            scene,
            cells: request.plan.methods.iter().map(cell).collect(),
            edges: None,
            failure: None,
            warnings: Vec::new(),
        }
    }

    /// Runs what is left to do, on one device after another: where one is lost, the cell that lost it has
    /// failed, and the others go on.
    fn on_devices(&mut self, gpu: &mut Gpu, dir: &mut RunDir) -> Result<(), RunDirError> {
        loop {
            if let Some(loss) = gpu.lost() {
                match gpu.reopen() {
                    Ok(opened) => *gpu = opened,
                    Err(error) => {
                        let error = anyhow::Error::new(error);
                        self.fail(&error.context(format!("{loss}, and cannot be opened again")));
                        return Ok(());
                    }
                }
            }
            let open = self.open_cells();
            match self.on_device(gpu, dir) {
                Ok(()) => {}
                Err(Broken::Run(error)) => return Err(error),
                Err(Broken::Scene(error)) => self.fail(&error),
            }
            let Some(loss) = gpu.lost() else {
                return Ok(());
            };
            self.warnings
                .push(format!("{}: {loss}; it was opened again", self.scene.name));
            self.cells.iter_mut().for_each(CellRun::forget_device);
            // Without an end to blame on a cell, this would go on for ever.
            if self.open_cells() == open {
                self.fail(&loss.into());
            }
            if self.open_cells() == 0 {
                return Ok(());
            }
        }
    }

    fn open_cells(&self) -> usize {
        self.cells.iter().filter(|run| run.is_open()).count()
    }

    /// Ends all that has not ended yet.
    fn fail(&mut self, error: &anyhow::Error) {
        let reason = in_one_line(error);
        for run in self.cells.iter_mut().filter(|run| run.is_open()) {
            run.fail(&reason);
        }
        self.failure = Some(reason);
    }

    /// Runs what is left to do until that is done, or the device is lost.
    fn on_device(&mut self, gpu: &Gpu, dir: &mut RunDir) -> Result<(), Broken> {
        let (request, scene) = (self.request, self.scene);
        let verified = request.plan.verified_frames() > 0;
        let open = || self.cells.iter().filter(|run| run.is_open());
        let setups = open().map(|run| run.plan.method.depth_setup());
        let stages = FrameResources::for_setups(gpu, scene, request.plan.size_px, setups)
            .context("the scene cannot be drawn")?;
        let context = PrepareContext::new(gpu, scene, &stages[0]);
        let searched = open().any(|run| run.plan.method.bias_search().is_some());
        let verifiers: Vec<Verifier<'_>> = if verified || searched {
            let first = Verifier::new(gpu, scene, &stages[0], request.cache)?;
            stages.iter().map(|stage| first.on(stage)).collect()
        } else {
            Vec::new()
        };
        let mut preparation = Preparation {
            request,
            context: &context,
            stages: &stages,
            verifiers: &verifiers,
            truths: vec![None; stages.len()],
            dir,
        };
        for run in self.cells.iter_mut().filter(|run| run.is_open()) {
            preparation.prepare(run)?;
            if gpu.lost().is_some() {
                return Ok(());
            }
        }
        self.edges = self.edges.or_else(|| edges(&context));
        if verified {
            verify_cells(request, gpu, scene, &verifiers, &mut self.cells, dir)?;
        }
        if gpu.lost().is_none() {
            request
                .observer
                .phase(&format!("{}: measuring", scene.name));
            let schedule = Schedule {
                frames: request.plan.frames,
                warmup_frames: request.plan.warmup_frames,
                seed: request.plan.seed,
            };
            measure(
                gpu,
                scene,
                &stages,
                &mut self.cells,
                schedule,
                (request.observer, dir),
            )?;
        }
        Ok(())
    }

    fn outcome(self) -> SceneOutcome {
        let verified = self.request.plan.verified_frames() > 0;
        let notes = self.scene.notes.iter();
        let notes = notes.map(|note| format!("{}: {note}", self.scene.name));
        let mut warnings: Vec<_> = notes.chain(self.warnings).collect();
        warnings.extend(undecided(self.scene, &self.cells));
        for run in &self.cells {
            for text in &run.warnings {
                let warning = format!("{}, {}: {text}", self.scene.name, run.cell.method);
                if !warnings.contains(&warning) {
                    warnings.push(warning);
                }
            }
        }
        SceneOutcome {
            record: scene_record(self.scene, self.edges, self.failure),
            methods: self.cells.iter().map(CellRun::method_record).collect(),
            summaries: self.cells.iter().map(|run| run.summary(verified)).collect(),
            warnings,
        }
    }
}

fn edges(context: &PrepareContext<'_>) -> Option<EdgeRecord> {
    context.topology_if_built().map(|topology| {
        let counts = topology.counts();
        EdgeRecord {
            boundary: counts.boundary as u64,
            manifold: counts.manifold as u64,
            non_manifold: counts.non_manifold as u64,
        }
    })
}

fn scene_record(scene: &Scene, edges: Option<EdgeRecord>, failure: Option<String>) -> SceneRecord {
    let light = scene.flight.at(0.0).light;
    SceneRecord {
        name: scene.name.clone(),
        title: scene.title.clone(),
        triangles: Some(scene.mesh.caster_triangle_count() as u64),
        objects: Some(scene.mesh.caster_object_count() as u64),
        mesh_hash: scene.mesh_hash.clone(),
        light: light.place.truncate().to_array(),
        light_w: light.place.w,
        light_moves: scene.flight.light.duration_s() > 0.0,
        edges,
        status: match failure {
            Some(_) => Status::Failed,
            None => Status::Ok,
        },
        reason: failure.unwrap_or_default(),
    }
}

/// Words on the frame of which the truth can decide least, where that is much.
fn undecided(scene: &Scene, cells: &[CellRun<'_>]) -> Option<String> {
    let frames = cells.iter().flat_map(|run| &run.verified);
    let worst = frames.max_by_key(|frame| frame.px("ambiguous_px"))?;
    let words = metrics::undecided(worst.px("ambiguous_px"), worst.px("compared_px"))?;
    Some(format!("{}, at {:.1} s: {words}", scene.name, worst.time_s))
}
