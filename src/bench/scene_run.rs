//! One scene of a run: prepare every method, verify, measure, sum up.

use super::measure::{Measured, Schedule, measure};
use super::record::{
    Cell, EdgeRecord, FrameError, ImageKind, MethodRecord, Sample, SceneRecord, Status, Summary,
    counts_to_text, stages_to_text,
};
use super::run_dir::RunDir;
use super::verify::Judgement;
use super::{RunRequest, Verifier};
use crate::config::ScenePlan;
use crate::frame::{GBUFFER_STAGE, SHADE_STAGE, Stage};
use crate::image::Image;
use crate::methods::{MethodError, PrepareContext, PreparedMethod, ShadowMethod};
use crate::scene::{Scene, SceneError};

/// What a scene's part of the run came to.
pub(super) struct SceneOutcome {
    pub record: SceneRecord,
    pub methods: Vec<MethodRecord>,
    pub summaries: Vec<Summary>,
    pub warnings: Vec<String>,
}

/// A method on this scene, measured or on the way to it.
struct CellRun<'a> {
    method: &'a dyn ShadowMethod,
    cell: Cell,
    state: State,
    errors: Vec<FrameError>,
    samples: Vec<Sample>,
    stages: Vec<String>,
}

enum State {
    Ready(Box<dyn PreparedMethod>),
    Not(Status, String),
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
    // With its causes: they name the line of the model that is at fault.
    // In one line, with its causes: a scene's own error may not say which line of its model is at
    // fault.
    let reason = format!("{:#}", anyhow::Error::new(error));
    let reason = reason.split_whitespace().collect::<Vec<_>>().join(" ");
    let (width, height) = request.plan.size_px;
    let cell = |method: &dyn ShadowMethod| Cell {
        scene: plan.file.name.clone(),
        method: method.info().id.to_owned(),
        variant: method.variant(),
        width,
        height,
        ..Cell::default()
    };
    SceneOutcome {
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
            reason: reason.clone(),
        },
        methods: Vec::new(),
        summaries: request
            .plan
            .methods
            .iter()
            .map(|method| Summary::from_samples(&cell(method.as_ref()), &[], &[], status, &reason))
            .collect(),
        warnings: Vec::new(),
    }
}

fn run_loaded(
    request: &RunRequest<'_>,
    scene: &Scene,
    dir: &mut RunDir,
) -> anyhow::Result<SceneOutcome> {
    let (width, height) = request.plan.size_px;
    let stage = Stage::new(request.gpu, scene, width, height);
    let context = PrepareContext::new(request.gpu, scene, &stage);
    let mut cells: Vec<_> = request
        .plan
        .methods
        .iter()
        .map(|m| prepare(request, &context, m.as_ref()))
        .collect();
    let mut warnings = Vec::new();
    for run in &cells {
        if let State::Ready(prepared) = &run.state {
            let name = &run.cell.method;
            warnings.extend(
                prepared
                    .warnings()
                    .iter()
                    .map(|text| format!("{}, {name}: {text}", scene.name)),
            );
        }
    }
    if request.plan.verified_frames > 0 {
        verify(request, scene, &stage, &mut cells, dir)?;
    }
    measure_cells(request, scene, &stage, &mut cells, dir)?;
    let verified = request.plan.verified_frames > 0;
    let edges = context.topology_if_built().map(|topology| {
        let counts = topology.counts();
        EdgeRecord {
            boundary: counts.boundary as u64,
            manifold: counts.manifold as u64,
            non_manifold: counts.non_manifold as u64,
        }
    });
    Ok(SceneOutcome {
        record: SceneRecord {
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
        },
        methods: cells.iter().map(CellRun::method_record).collect(),
        summaries: cells.iter().map(|run| run.summary(verified)).collect(),
        warnings,
    })
}

fn prepare<'a>(
    request: &RunRequest<'_>,
    context: &PrepareContext<'_>,
    method: &'a dyn ShadowMethod,
) -> CellRun<'a> {
    let (scene, info) = (context.scene, method.info());
    request
        .observer
        .phase(&format!("{}: preparing {}", scene.name, info.id));
    let state = match info.check(request.gpu).map_err(MethodError::Unavailable) {
        Ok(()) => method.prepare(context),
        Err(error) => Err(error),
    };
    let state = match state {
        Ok(prepared) => State::Ready(prepared),
        Err(error @ MethodError::Unavailable(_)) => {
            State::Not(Status::Unavailable, error.to_string())
        }
        Err(error) => State::Not(Status::Failed, error.to_string()),
    };
    if let State::Not(..) = state {
        request.observer.advance(request.plan.steps_per_cell());
    }
    CellRun {
        method,
        cell: Cell {
            scene: scene.name.clone(),
            triangles: Some(scene.mesh.caster_triangle_count() as u64),
            objects: Some(scene.mesh.caster_object_count() as u64),
            method: info.id.to_owned(),
            variant: method.variant(),
            width: request.plan.size_px.0,
            height: request.plan.size_px.1,
            counters: match &state {
                State::Ready(prepared) => counts_to_text(prepared.counters()),
                State::Not(..) => String::new(),
            },
        },
        state,
        errors: Vec::new(),
        samples: Vec::new(),
        stages: Vec::new(),
    }
}

/// Compares every method with the truth in some frames of the flight, and keeps the pictures of
/// the first.
fn verify(
    request: &RunRequest<'_>,
    scene: &Scene,
    stage: &Stage,
    cells: &mut [CellRun<'_>],
    dir: &mut RunDir,
) -> anyhow::Result<()> {
    let verifier = Verifier::new(request.gpu, scene, stage, request.cache)?;
    let size_px = request.plan.size_px;
    for (i, time_s) in request
        .plan
        .verified_times(&scene.camera)
        .into_iter()
        .enumerate()
    {
        if request.observer.interrupted() {
            break;
        }
        request.observer.phase(&format!(
            "{}: tracing the truth at {time_s:.1} s",
            scene.name
        ));
        let truth = verifier.truth(&scene.camera.view_at(time_s))?;
        if i == 0 {
            let grey = truth.mask.to_grey();
            let image = Image::grey(size_px, &grey);
            dir.write_image((&scene.name, "", ""), ImageKind::Reference, &image)?;
        }
        for run in &mut *cells {
            let State::Ready(prepared) = &run.state else {
                continue;
            };
            request
                .observer
                .phase(&format!("{}: verifying {}", scene.name, run.cell.method));
            let mask = verifier.draw_mask(prepared.as_ref())?;
            let judgement = verifier.judge(&mask, &truth)?;
            let error = frame_error(&run.cell, i as u32, time_s, &judgement);
            dir.append_error(&error)?;
            run.errors.push(error);
            if i == 0 {
                let picture = verifier.read_picture()?;
                let cell = (&*scene.name, &*run.cell.method, &*run.cell.variant);
                let write = |kind, image: Image<'_>| dir.write_image(cell, kind, &image);
                write(ImageKind::Picture, Image::rgba(size_px, &picture))?;
                write(ImageKind::Mask, Image::grey(size_px, &mask))?;
                write(ImageKind::Error, Image::rgb(size_px, &judgement.error_map))?;
            }
            request.observer.advance(1);
        }
    }
    Ok(())
}

fn frame_error(cell: &Cell, frame: u32, time_s: f64, judgement: &Judgement) -> FrameError {
    let error = &judgement.error;
    FrameError {
        scene: cell.scene.clone(),
        method: cell.method.clone(),
        variant: cell.variant.clone(),
        width: cell.width,
        height: cell.height,
        frame,
        time_s,
        false_lit: error.false_lit,
        false_shadowed: error.false_shadowed,
        boundary_px: error.boundary_px,
        artifact_px: error.artifact_px,
        ambiguous_px: error.ambiguous_px,
        compared_px: error.compared_px,
        ..FrameError::default()
    }
}

fn measure_cells(
    request: &RunRequest<'_>,
    scene: &Scene,
    stage: &Stage,
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
    let ready: Vec<usize> = (0..cells.len())
        .filter(|&i| matches!(cells[i].state, State::Ready(_)))
        .collect();
    let mut kept: Vec<Vec<Measured>> = cells.iter().map(|_| Vec::new()).collect();
    {
        let methods: Vec<&dyn PreparedMethod> = ready
            .iter()
            .filter_map(|&i| match &cells[i].state {
                State::Ready(prepared) => Some(prepared.as_ref()),
                State::Not(..) => None,
            })
            .collect();
        measure(
            request.gpu,
            scene,
            stage,
            &methods,
            schedule,
            request.observer,
            |measured| {
                let cell = ready[measured.method];
                dir.append(&sample(&cells[cell].cell, &measured))?;
                kept[cell].push(measured);
                Ok(())
            },
        )?;
    }
    for (run, measured) in cells.iter_mut().zip(kept) {
        run.samples = measured
            .iter()
            .map(|measured| sample(&run.cell, measured))
            .collect();
        if let Some(first) = measured.first() {
            run.stages = first
                .times
                .stages
                .iter()
                .map(|(name, _)| (*name).to_owned())
                .collect();
        }
    }
    Ok(())
}

fn sample(cell: &Cell, measured: &Measured) -> Sample {
    let times = &measured.times;
    let own = times
        .stages
        .iter()
        .copied()
        .filter(|(name, _)| ![GBUFFER_STAGE, SHADE_STAGE].contains(name));
    Sample {
        scene: cell.scene.clone(),
        triangles: cell.triangles.unwrap_or(0),
        objects: cell.objects.unwrap_or(0),
        method: cell.method.clone(),
        variant: cell.variant.clone(),
        width: cell.width,
        height: cell.height,
        frame: measured.frame,
        time_s: measured.time_s,
        order: measured.order,
        frame_ms: times.frame_ms(),
        gbuffer_ms: times.stage_ms(GBUFFER_STAGE),
        shadow_ms: measured.shadow_ms(),
        shade_ms: times.stage_ms(SHADE_STAGE),
        cpu_ms: times.cpu_ms,
        record_ms: times.record_ms,
        draw_calls: times.draw_calls,
        stages: stages_to_text(own),
    }
}

impl CellRun<'_> {
    fn method_record(&self) -> MethodRecord {
        MethodRecord {
            id: self.cell.method.clone(),
            variant: self.cell.variant.clone(),
            title: self.method.info().title.to_owned(),
            stages: self.stages.clone(),
            sweep: None,
        }
    }

    fn summary(&self, verified: bool) -> Summary {
        let (status, reason) = match &self.state {
            State::Not(status, reason) => (*status, reason.as_str()),
            State::Ready(_) if self.samples.is_empty() => (Status::Skipped, "interrupted"),
            State::Ready(_) if !verified => (Status::Unverified, ""),
            State::Ready(_) => (Status::Ok, ""),
        };
        Summary::from_samples(&self.cell, &self.samples, &self.errors, status, reason)
    }
}
