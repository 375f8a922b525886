//! A method on a scene: one cell of a run's matrix, measured or on the way to it.

use super::executor::Prepared;
use super::time_limit::TimeLimit;
use crate::config::{MethodPlan, RunPlan};
use crate::frame::{DepthSetup, DrawnVolumes, GBUFFER_STAGE, SHADE_STAGE};
use crate::gpu::{FrameTimes, StageTime};
use crate::judge::NoPicture;
use crate::methods::ShadowMethod;
use crate::record::{
    Cell, MethodRecord, Sample, StageMs, Status, Summary, SweepRecord, VerifiedFrame,
};
use crate::scene::Scene;

/// One cell.
pub(super) struct CellRun<'a> {
    pub plan: &'a MethodPlan,
    pub cell: Cell,
    pub state: State,
    /// The time that it may take.
    pub time: TimeLimit,
    /// The bias that was found, if one was looked for.
    pub bias: Option<f64>,
    /// What a reader of its results should know.
    pub warnings: Vec<String>,
    pub verified: Vec<VerifiedFrame>,
    pub samples: Vec<Sample>,
    pub stages: Vec<String>,
}

/// Whether it can be drawn.
pub(super) enum State {
    /// It is yet to be made ready, or ready again on another device.
    Planned,
    Ready,
    Not(Status, String),
}

/// A frame that was measured.
pub(super) struct Measured {
    /// Number of the frame along the flight.
    pub frame: u32,
    /// Its time on the flight.
    pub time_s: f64,
    /// Its place in the order in which frames were drawn.
    pub order: u64,
    /// Its times.
    pub times: FrameTimes,
    /// How its volumes were drawn, if it has any.
    pub volumes: Option<DrawnVolumes>,
}

impl Measured {
    /// What the method adds to a frame: everything but G-buffer and shading.
    pub(super) fn shadow_ms(&self) -> f64 {
        let shared = self.times.stage_ms(GBUFFER_STAGE) + self.times.stage_ms(SHADE_STAGE);
        self.times.frame_ms() - shared
    }
}

/// Stages of the same name together, in the order in which the first of each ran.
fn by_name<'a>(stages: impl Iterator<Item = &'a StageTime>) -> Vec<StageMs> {
    let mut all: Vec<StageMs> = Vec::new();
    for stage in stages {
        let at = all.iter().position(|known| known.stage == stage.name);
        let at = at.unwrap_or_else(|| {
            all.push(StageMs {
                stage: stage.name.to_owned(),
                ..StageMs::default()
            });
            all.len() - 1
        });
        all[at].device_ms += stage.device_ms;
        all[at].cpu_ms += stage.processor_ms;
    }
    all
}

/// What a cell of this method is called in results.
pub(super) fn name_cell(
    scene: &str,
    method: &dyn ShadowMethod,
    (width, height): (u32, u32),
) -> Cell {
    Cell {
        scene: scene.to_owned(),
        method: method.info().id.to_owned(),
        variant: method.variant(),
        width,
        height,
        ..Cell::default()
    }
}

impl<'a> CellRun<'a> {
    pub(super) fn new(
        run: &RunPlan,
        plan: &'a MethodPlan,
        scene: &Scene,
        size_px: (u32, u32),
    ) -> Self {
        Self {
            plan,
            time: TimeLimit::new(run.cell_timeout),
            cell: Cell {
                triangles: Some(scene.mesh.caster_triangle_count() as u64),
                objects: Some(scene.mesh.caster_object_count() as u64),
                ..name_cell(&scene.name, plan.method.as_ref(), size_px)
            },
            state: State::Planned,
            bias: None,
            warnings: Vec::new(),
            verified: Vec::new(),
            samples: Vec::new(),
            stages: Vec::new(),
        }
    }

    /// Whether it can be drawn.
    pub(super) fn is_ready(&self) -> bool {
        matches!(self.state, State::Ready)
    }

    /// The depth buffer that its frames are drawn with.
    pub(super) fn depth(&self) -> DepthSetup {
        self.plan.method.depth_setup()
    }

    /// Whether there is something left to do.
    pub(super) fn is_open(&self) -> bool {
        !matches!(self.state, State::Not(..))
    }

    /// It was made ready.
    pub(super) fn ready(&mut self, prepared: Prepared) {
        let counters = prepared.counters.into_iter();
        self.cell.counters = counters.map(|(n, count)| (n.to_owned(), count)).collect();
        self.warnings = prepared.warnings;
        self.state = State::Ready;
    }

    /// It cannot go on; what was measured so far stays.
    pub(super) fn refuse(&mut self, error: NoPicture) {
        match error {
            NoPicture::Unavailable(reason) => self.end(Status::Unavailable, reason),
            NoPicture::Failed(reason) => self.end(Status::Failed, reason),
        }
    }

    pub(super) fn end(&mut self, status: Status, reason: String) {
        self.state = State::Not(status, reason);
    }

    /// The device is gone, and what was prepared on it.
    pub(super) fn forget_device(&mut self) {
        if self.is_open() {
            self.state = State::Planned;
        }
    }

    /// Whether that frame was measured already, on a device that has been lost since.
    pub(super) fn has_sample(&self, frame: u32) -> bool {
        self.samples.iter().any(|sample| sample.frame == frame)
    }

    /// The row of a measured frame.
    pub(super) fn sample(&self, measured: &Measured) -> Sample {
        let times = &measured.times;
        let own = times
            .stages
            .iter()
            .filter(|stage| ![GBUFFER_STAGE, SHADE_STAGE].contains(&stage.name));
        let sum = |time: fn(&StageTime) -> f64| own.clone().map(time).sum();
        Sample {
            scene: self.cell.scene.clone(),
            triangles: self.cell.triangles.unwrap_or(0),
            objects: self.cell.objects.unwrap_or(0),
            method: self.cell.method.clone(),
            variant: self.cell.variant.clone(),
            width: self.cell.width,
            height: self.cell.height,
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
            shadow_device_ms: sum(|stage| stage.device_ms),
            shadow_cpu_ms: sum(|stage| stage.processor_ms),
            wait_ms: times.wait_ms,
            stages: by_name(own),
            volumes: measured.volumes,
        }
    }

    /// Takes a measured frame and its row in.
    pub(super) fn keep(&mut self, measured: &Measured, sample: Sample) {
        if self.stages.is_empty() {
            let names = measured.times.stages.iter().map(|stage| stage.name);
            self.stages = names.map(str::to_owned).collect();
        }
        self.samples.push(sample);
    }

    pub(super) fn method_record(&self) -> MethodRecord {
        MethodRecord {
            id: self.cell.method.clone(),
            variant: self.cell.variant.clone(),
            title: self.plan.method.info().title.to_owned(),
            stages: self.stages.clone(),
            sweep: self.plan.sweep.as_ref().map(|sweep| SweepRecord {
                curve: sweep.curve.clone(),
                parameter: sweep.parameter.clone(),
                value: sweep.value,
            }),
        }
    }

    pub(super) fn summary(&self, verified: bool) -> Summary {
        let (status, reason) = match &self.state {
            State::Not(status, reason) => (*status, reason.as_str()),
            _ if self.samples.is_empty() => (Status::Skipped, "interrupted"),
            _ if !verified => (Status::Unverified, ""),
            _ => (Status::Ok, ""),
        };
        Summary::from_samples(&self.cell, &self.samples, &self.verified, status, reason)
    }
}
