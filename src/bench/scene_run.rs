//! One scene of a run: find biases, prepare every method, verify, measure, sum up.

use super::Watched;
use super::cell::{CellRun, name_cell};
use super::executor::{Executor, Session, sequence};
use super::measure::measure;
use super::prepare::{find_biases, prepare};
use super::verify_cells::verify_cells;
use crate::config::{MethodPlan, RunPlan, ScenePlan};
use crate::judge::NoPicture;
use crate::metrics;
use crate::record::run_dir::RunDir;
use crate::record::{
    EdgeRecord, MethodRecord, RunDirError, SceneRecord, Status, Summary, in_one_line,
};
use crate::scene::file::MeshSource;
use crate::scene::{FrameError, Scene, SceneError};

/// What a scene's part of the run came to.
pub(super) struct SceneOutcome {
    pub record: SceneRecord,
    pub methods: Vec<MethodRecord>,
    pub summaries: Vec<Summary>,
    pub warnings: Vec<String>,
}

/// Runs one scene. What concerns the scene or one of its cells becomes their status; only what concerns the run
/// directory is an error.
pub(super) fn run_scene(
    watched: Watched<'_>,
    executor: &mut dyn Executor,
    scene: &ScenePlan,
    dir: &mut RunDir,
) -> Result<SceneOutcome, RunDirError> {
    let Watched { plan, observer } = watched;
    observer.phase(&format!("{}: loading", scene.file.name));
    let loaded = match load(executor, scene) {
        Ok(loaded) => loaded,
        Err(error) => {
            observer.advance(plan.steps_per_scene());
            return Ok(not_loaded(plan, scene, &error));
        }
    };
    let mut run = SceneRun::new(watched, &loaded, scene.size_px);
    match check_views(plan, &loaded) {
        Ok(()) => run.on_devices(executor, dir)?,
        Err(error) => {
            observer.advance(plan.steps_per_scene());
            run.fail(&in_one_line(&error.into()));
        }
    }
    Ok(run.outcome())
}

fn load(executor: &dyn Executor, plan: &ScenePlan) -> anyhow::Result<Scene> {
    // A grid that the device cannot take need not be built first.
    if let MeshSource::SphereGrid(grid) = &plan.file.mesh {
        executor.check_mesh(grid.triangle_count())?;
    }
    Ok(plan.file.load(&plan.search)?)
}

fn not_loaded(run: &RunPlan, plan: &ScenePlan, error: &anyhow::Error) -> SceneOutcome {
    let status = match error.downcast_ref() {
        Some(SceneError::MissingModel { .. }) => Status::Skipped,
        _ => Status::Failed,
    };
    // With its causes: a scene's own error may not say which line of its model is at fault.
    let reason = in_one_line(error);
    let summary = |method: &MethodPlan| {
        let cell = name_cell(&plan.file.name, method.method.as_ref(), run.size_of(plan));
        Summary::from_samples(&cell, &[], &[], status, &reason)
    };
    SceneOutcome {
        summaries: run.methods.iter().map(summary).collect(),
        record: SceneRecord {
            name: plan.file.name.clone(),
            title: plan.file.title.clone(),
            size_px: plan.size_px,
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
fn check_views(plan: &RunPlan, scene: &Scene) -> Result<(), FrameError> {
    let flight = &scene.flight;
    let measured_s = flight.frame_times(plan.frames as usize);
    let mut times_s = plan.verified_times(flight);
    times_s.extend(measured_s);
    let lead_in = |s: &f64| sequence(*s, plan.lead_in);
    times_s = times_s.iter().flat_map(lead_in).collect();
    let mut methods = plan.methods.iter();
    if methods.any(|plan| plan.method.bias_search().is_some()) {
        times_s.extend(plan.bias_times(flight));
    }
    flight.check_times(times_s.into_iter())
}

/// A scene that is being run.
struct SceneRun<'a> {
    watched: Watched<'a>,
    scene: &'a Scene,
    /// Of its pictures, where they are not those of the run.
    size_px: Option<(u32, u32)>,
    cells: Vec<CellRun<'a>>,
    edges: Option<EdgeRecord>,
    /// Why nothing of it goes on, if that is so.
    failure: Option<String>,
    warnings: Vec<String>,
}

impl<'a> SceneRun<'a> {
    fn new(watched: Watched<'a>, scene: &'a Scene, size_px: Option<(u32, u32)>) -> Self {
        let plan = watched.plan;
        let cell_px = size_px.unwrap_or(plan.size_px);
        let cell = |method| CellRun::new(plan, method, scene, cell_px);
        Self {
            watched,
            scene,
            size_px,
            cells: plan.methods.iter().map(cell).collect(),
            edges: None,
            failure: None,
            warnings: Vec::new(),
        }
    }

    /// Runs what is left to do, on one device after another: where one is lost, the cell that lost it has
    /// failed, and the others go on.
    fn on_devices(
        &mut self,
        executor: &mut dyn Executor,
        dir: &mut RunDir,
    ) -> Result<(), RunDirError> {
        let size_px = self.size_px.unwrap_or(self.watched.plan.size_px);
        loop {
            let mut session = match executor.open(self.scene, size_px) {
                Ok(session) => session,
                Err(error) => {
                    self.fail(&in_one_line(&error));
                    return Ok(());
                }
            };
            let open = self.open_cells();
            let done = self.on_device(session.as_mut(), dir);
            let loss = session.lost();
            session.close();
            done?;
            let Some(loss) = loss else {
                return Ok(());
            };
            self.warnings
                .push(format!("{}: {loss}; it was opened again", self.scene.name));
            self.cells.iter_mut().for_each(CellRun::forget_device);
            // Without an end to blame on a cell, this would go on for ever.
            if self.open_cells() == open {
                self.fail(&loss);
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
    fn fail(&mut self, reason: &str) {
        for run in self.cells.iter_mut().filter(|run| run.is_open()) {
            run.refuse(NoPicture::Failed(reason.to_owned()));
        }
        self.failure = Some(reason.to_owned());
    }

    /// Runs what is left to do until that is done, or the device is lost.
    fn on_device(
        &mut self,
        session: &mut dyn Session,
        dir: &mut RunDir,
    ) -> Result<(), RunDirError> {
        let (watched, scene, cells) = (self.watched, self.scene, &mut self.cells);
        find_biases(watched, session, cells, dir)?;
        prepare(watched, session, cells);
        self.edges = self.edges.or_else(|| session.edges());
        verify_cells(watched, scene, session, cells, dir)?;
        if session.lost().is_none() {
            let text = format!("{}: measuring", scene.name);
            watched.observer.phase(&text);
            measure(watched, &scene.flight, session, cells, dir)?;
        }
        Ok(())
    }

    fn outcome(self) -> SceneOutcome {
        let verified = self.watched.plan.verified_frames() > 0;
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
            record: SceneRecord {
                size_px: self.size_px,
                ..scene_record(self.scene, self.edges, self.failure)
            },
            methods: self.cells.iter().map(CellRun::method_record).collect(),
            summaries: self.cells.iter().map(|run| run.summary(verified)).collect(),
            warnings,
        }
    }
}

fn scene_record(scene: &Scene, edges: Option<EdgeRecord>, failure: Option<String>) -> SceneRecord {
    let light = scene.flight.at(0.0).light;
    SceneRecord {
        name: scene.name.clone(),
        title: scene.title.clone(),
        size_px: None,
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
