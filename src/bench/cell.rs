//! A method on a scene: one cell of a run's matrix, measured or on the way to it.

use super::measure::Measured;
use super::record::{
    Cell, FrameError, MethodRecord, Sample, Status, Summary, SweepRecord, pairs_to_text,
};
use crate::config::MethodPlan;
use crate::frame::{GBUFFER_STAGE, SHADE_STAGE};
use crate::methods::{MethodError, PreparedMethod, ShadowMethod};
use crate::scene::Scene;

/// One cell.
pub(super) struct CellRun<'a> {
    pub plan: &'a MethodPlan,
    pub cell: Cell,
    pub state: State,
    /// Index of the stage that it is drawn on.
    pub stage: usize,
    pub errors: Vec<FrameError>,
    pub samples: Vec<Sample>,
    pub stages: Vec<String>,
}

/// Whether it can be drawn.
pub(super) enum State {
    Ready(Box<dyn PreparedMethod>),
    Not(Status, String),
}

impl State {
    /// A method that was prepared, or not.
    pub(super) fn of(prepared: Result<Box<dyn PreparedMethod>, MethodError>) -> Self {
        match prepared {
            Ok(prepared) => Self::Ready(prepared),
            Err(error @ MethodError::Unavailable(_)) => {
                Self::Not(Status::Unavailable, error.to_string())
            }
            Err(error) => Self::Not(Status::Failed, error.to_string()),
        }
    }
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
        plan: &'a MethodPlan,
        scene: &Scene,
        size_px: (u32, u32),
        stage: usize,
        state: State,
    ) -> Self {
        Self {
            plan,
            cell: Cell {
                triangles: Some(scene.mesh.caster_triangle_count() as u64),
                objects: Some(scene.mesh.caster_object_count() as u64),
                counters: match &state {
                    State::Ready(prepared) => pairs_to_text(prepared.counters()),
                    State::Not(..) => String::new(),
                },
                ..name_cell(&scene.name, plan.method.as_ref(), size_px)
            },
            state,
            stage,
            errors: Vec::new(),
            samples: Vec::new(),
            stages: Vec::new(),
        }
    }

    /// The method, if it can be drawn.
    pub(super) fn prepared(&self) -> Option<&dyn PreparedMethod> {
        match &self.state {
            State::Ready(prepared) => Some(prepared.as_ref()),
            State::Not(..) => None,
        }
    }

    /// The row of a measured frame.
    pub(super) fn sample(&self, measured: &Measured) -> Sample {
        let times = &measured.times;
        let own = times
            .stages
            .iter()
            .copied()
            .filter(|(name, _)| ![GBUFFER_STAGE, SHADE_STAGE].contains(name));
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
            stages: pairs_to_text(own),
        }
    }

    /// Takes a measured frame and its row in.
    pub(super) fn keep(&mut self, measured: &Measured, sample: Sample) {
        if self.stages.is_empty() {
            let names = measured.times.stages.iter().map(|(name, _)| *name);
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
            State::Ready(_) if self.samples.is_empty() => (Status::Skipped, "interrupted"),
            State::Ready(_) if !verified => (Status::Unverified, ""),
            State::Ready(_) => (Status::Ok, ""),
        };
        Summary::from_samples(&self.cell, &self.samples, &self.errors, status, reason)
    }
}
