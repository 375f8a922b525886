//! One scene of a run: prepare every method, verify, measure, sum up.

use super::cell::{CellRun, State, name_cell};
use super::measure::{Schedule, measure};
use super::record::{EdgeRecord, MethodRecord, SceneRecord, Status, Summary};
use super::run_dir::RunDir;
use super::verify::Truth;
use super::verify_cells::verify_cells;
use super::{RunRequest, Verifier, bias_search};
use crate::config::{MethodPlan, ScenePlan};
use crate::frame::Stage;
use crate::methods::{BiasSearch, MethodError, PrepareContext, PreparedMethod};
use crate::scene::{Scene, SceneError};
use std::rc::Rc;

/// What a scene's part of the run came to.
pub(super) struct SceneOutcome {
    pub record: SceneRecord,
    pub methods: Vec<MethodRecord>,
    pub summaries: Vec<Summary>,
    pub warnings: Vec<String>,
}

/// Runs one scene. An error ends the run (the device is lost, the disk is full); what concerns one
/// cell or scene alone becomes its status.
pub(super) fn run_scene(
    request: &RunRequest<'_>,
    plan: &ScenePlan,
    dir: &mut RunDir,
) -> anyhow::Result<SceneOutcome> {
    request
        .observer
        .phase(&format!("{}: loading", plan.file.name));
    match plan.file.load(&plan.search) {
        Ok(scene) => run_loaded(request, &scene, dir),
        Err(error) => {
            request.observer.advance(request.plan.steps_per_scene());
            Ok(not_loaded(request, plan, error))
        }
    }
}

fn not_loaded(request: &RunRequest<'_>, plan: &ScenePlan, error: SceneError) -> SceneOutcome {
    let status = match error {
        SceneError::MissingModel { .. } => Status::Skipped,
        _ => Status::Failed,
    };
    // In one line, with its causes: a scene's own error may not say which line of its model is at
    // fault.
    let reason = format!("{:#}", anyhow::Error::new(error));
    let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ");
    let summary = |method: &MethodPlan| {
        let cell = name_cell(
            &plan.file.name,
            method.method.as_ref(),
            request.plan.size_px,
        );
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
            edges: None,
            status,
            reason,
        },
        methods: Vec::new(),
        warnings: Vec::new(),
    }
}

fn run_loaded(
    request: &RunRequest<'_>,
    scene: &Scene,
    dir: &mut RunDir,
) -> anyhow::Result<SceneOutcome> {
    let setups = request
        .plan
        .methods
        .iter()
        .map(|plan| plan.method.depth_setup());
    let stages = Stage::for_setups(request.gpu, scene, request.plan.size_px, setups);
    let context = PrepareContext::new(request.gpu, scene, &stages[0]);
    let methods = &request.plan.methods;
    let verified = request.plan.verified_frames() > 0;
    let searched = methods
        .iter()
        .any(|plan| plan.method.bias_search().is_some());
    let verifiers: Vec<Verifier<'_>> = if verified || searched {
        let first = Verifier::new(request.gpu, scene, &stages[0], request.cache)?;
        stages.iter().map(|stage| first.on(stage)).collect()
    } else {
        Vec::new()
    };
    let mut biases = BiasFinder {
        request,
        truths: vec![None; stages.len()],
        verifiers: &verifiers,
        dir,
    };
    let mut cells = Vec::new();
    for plan in methods {
        let setup = plan.method.depth_setup();
        let stage = stages.iter().position(|stage| stage.depth == setup);
        let state = match stage {
            Some(stage) => {
                let context = context.on(&stages[stage]);
                prepare(request, &context, plan, |search| {
                    biases.find(plan, search, &context, stage)
                })?
            }
            None => State::of(Err(setup
                .check(request.gpu)
                .map_or_else(MethodError::Unavailable, |()| {
                    unreachable!("there is a stage for each setup that the device can draw")
                }))),
        };
        if let State::Not(..) = state {
            request.observer.advance(request.plan.steps_per_cell());
        }
        let size_px = request.plan.size_px;
        cells.push(CellRun::new(
            plan,
            scene,
            size_px,
            stage.unwrap_or(0),
            state,
        ));
    }
    if verified {
        verify_cells(request, scene, &verifiers, &mut cells, dir)?;
    }
    measure_cells(request, scene, &stages, &mut cells, dir)?;
    Ok(SceneOutcome {
        record: scene_record(scene, &context),
        methods: cells.iter().map(CellRun::method_record).collect(),
        summaries: cells.iter().map(|run| run.summary(verified)).collect(),
        warnings: warnings(scene, &cells),
    })
}

/// Makes a method ready; `find` searches for its bias, if it asks for that.
fn prepare(
    request: &RunRequest<'_>,
    context: &PrepareContext<'_>,
    plan: &MethodPlan,
    find: impl FnOnce(&BiasSearch<'_>) -> anyhow::Result<Option<f64>>,
) -> anyhow::Result<State> {
    let method = plan.method.as_ref();
    let info = method.info();
    if let Err(reason) = info.check(request.gpu) {
        return Ok(State::of(Err(MethodError::Unavailable(reason))));
    }
    let Some(search) = method.bias_search() else {
        let text = format!("{}: preparing {}", context.scene.name, info.id);
        request.observer.phase(&text);
        return Ok(State::of(method.prepare(context)));
    };
    match find(&search) {
        Ok(Some(bias)) => Ok(State::of((search.with_bias)(bias).prepare(context))),
        Ok(None) => Ok(State::Not(Status::Skipped, "interrupted".to_owned())),
        Err(error) => Ok(State::of(Err(error.downcast::<MethodError>()?))),
    }
}

/// Finds biases, and keeps what is true at the views where they are tried.
struct BiasFinder<'a> {
    request: &'a RunRequest<'a>,
    verifiers: &'a [Verifier<'a>],
    /// Of each stage, once somebody searches on it.
    truths: Vec<Option<Rc<[Truth]>>>,
    dir: &'a mut RunDir,
}

impl BiasFinder<'_> {
    fn find(
        &mut self,
        plan: &MethodPlan,
        search: &BiasSearch<'_>,
        context: &PrepareContext<'_>,
        stage: usize,
    ) -> anyhow::Result<Option<f64>> {
        let (request, scene) = (self.request, context.scene);
        let cell = name_cell(&scene.name, plan.method.as_ref(), request.plan.size_px);
        let text = format!("{}: finding the bias of {}", cell.scene, cell.method);
        request.observer.phase(&text);
        let verifier = &self.verifiers[stage];
        let truths = match &self.truths[stage] {
            Some(truths) => Rc::clone(truths),
            None => {
                let times_s = bias_search::times(request.plan, &scene.camera).into_iter();
                let truths = times_s.map(|s| verifier.truth(&scene.camera.view_at(s)));
                let truths: Rc<[Truth]> = truths.collect::<anyhow::Result<_>>()?;
                Rc::clone(self.truths[stage].insert(truths))
            }
        };
        let on = (verifier, &*truths);
        let found = bias_search::find(&cell, search, context, on, request.observer)?;
        if let Some(found) = &found {
            self.dir.append_bias(&found.row)?;
        }
        Ok(found.map(|found| found.slope_bias))
    }
}

fn measure_cells(
    request: &RunRequest<'_>,
    scene: &Scene,
    stages: &[Stage],
    cells: &mut [CellRun<'_>],
    dir: &mut RunDir,
) -> anyhow::Result<()> {
    request
        .observer
        .phase(&format!("{}: measuring", scene.name));
    let schedule = Schedule {
        frames: request.plan.frames,
        warmup_frames: request.plan.warmup_frames,
        seed: request.plan.seed,
    };
    let mut kept = Vec::new();
    let (ready, methods): (Vec<usize>, Vec<(usize, &dyn PreparedMethod)>) = cells
        .iter()
        .enumerate()
        .filter_map(|(i, run)| Some((i, (run.stage, run.prepared()?))))
        .unzip();
    measure(
        request.gpu,
        scene,
        (stages, &methods),
        schedule,
        request.observer,
        |measured| {
            let sample = cells[ready[measured.method]].sample(&measured);
            dir.append_sample(&sample)?;
            kept.push((measured, sample));
            Ok(())
        },
    )?;
    for (measured, sample) in kept {
        cells[ready[measured.method]].keep(&measured, sample);
    }
    Ok(())
}

fn scene_record(scene: &Scene, context: &PrepareContext<'_>) -> SceneRecord {
    let edges = context.topology_if_built().map(|topology| {
        let counts = topology.counts();
        EdgeRecord {
            boundary: counts.boundary as u64,
            manifold: counts.manifold as u64,
            non_manifold: counts.non_manifold as u64,
        }
    });
    SceneRecord {
        name: scene.name.clone(),
        title: scene.title.clone(),
        triangles: Some(scene.mesh.caster_triangle_count() as u64),
        objects: Some(scene.mesh.caster_object_count() as u64),
        mesh_hash: scene.mesh_hash.clone(),
        light: scene.light.truncate().to_array(),
        light_w: scene.light.w,
        edges,
        status: Status::Ok,
        reason: String::new(),
    }
}

/// What the reader of a scene's results should know, each thing once.
fn warnings(scene: &Scene, cells: &[CellRun<'_>]) -> Vec<String> {
    let notes = scene.notes.iter();
    let mut warnings: Vec<_> = notes
        .map(|note| format!("{}: {note}", scene.name))
        .collect();
    for run in cells {
        for text in run.prepared().map(|p| p.warnings()).unwrap_or_default() {
            let warning = format!("{}, {}: {text}", scene.name, run.cell.method);
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
    }
    warnings
}
