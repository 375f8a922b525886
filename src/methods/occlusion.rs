//! Which objects' shadow volumes are hidden, found out by occlusion queries of boxes extruded from the light.

use super::PrepareContext;
use super::plan::FramePlan;
use super::volume_parameters::{Culling, Plan, VolumeParameters};
use crate::frame::occlusion::{Culler, Look, Sight, margin};
use crate::frame::{Frame, FrameResources, FrameView};
use crate::geometry::{Bounds, NearVolume, VisibleFaces};
use crate::gpu::Gpu;
use glam::DVec3;

/// Name of the stages that ask.
pub(super) const OCCLUSION_STAGE: &str = "occlusion";

/// A plan asks for what is hidden in scenes of so many casters: with fewer, what it may save is less than what asking costs.
const MANY_CASTERS: usize = 1000;

/// Finds out which volumes are hidden.
pub(super) struct Occlusion {
    culler: Culler,
    /// Casters that the plan of the frame under way draws unless they are hidden.
    wanted: Vec<bool>,
}

/// What a frame asks by.
pub(super) struct VolumeLook {
    view: FrameView,
    near: NearVolume,
    margin: f64,
}

impl VolumeLook {
    pub(super) fn new(resources: &FrameResources) -> Self {
        let view = resources.view();
        Self {
            near: view.near_volume(),
            margin: margin(&view, &resources.extents, resources.targets.height),
            view,
        }
    }
}

impl Look for VolumeLook {
    fn eye(&self) -> DVec3 {
        self.view.eye.as_dvec3()
    }

    fn sight(&self, bounds: Bounds) -> Sight {
        if !self.view.may_see_shadow_of(bounds) {
            return Sight::Out;
        }
        let bounds = bounds.larger_by(self.margin);
        // Inside of the volume, or around the light, no surface of it need be in view.
        if self.near.may_meet(bounds) || !self.view.is_outside_of_lamp(bounds) {
            return Sight::Around;
        }
        Sight::InView
    }

    fn push(&self, faces: &mut VisibleFaces, bounds: Bounds) {
        let light = self.view.light.place.as_dvec4();
        faces.push_volume(
            bounds.larger_by(self.margin),
            light,
            &self.view.end_planes,
            self.eye(),
        );
    }
}

impl Occlusion {
    /// For volumes of these parameters; `None` if they do not ask for it.
    pub(super) fn wanted(
        context: &PrepareContext<'_>,
        parameters: VolumeParameters,
    ) -> Option<Self> {
        let is_city = context.resources.extents.casters.len() >= MANY_CASTERS;
        let is_wanted = match parameters.culling {
            Culling::Occlusion => true,
            Culling::Frustum => parameters.plan == Plan::Auto && is_city,
            Culling::None | Culling::OcclusionGpu => false,
        };
        is_wanted.then(|| Self::new(context.gpu, context.resources))
    }

    fn new(gpu: &Gpu, resources: &FrameResources) -> Self {
        let casters = &resources.extents.casters;
        Self {
            culler: Culler::new(gpu, &resources.depth_buffer(), casters, 0),
            wanted: Vec::new(),
        }
    }

    /// The next frame does not follow the one before.
    pub(super) fn forget(&mut self) {
        self.culler.forget();
    }

    /// Begins a frame: leaves those of the plan that are taken to be visible, and asks about the others.
    pub(super) fn begin(
        &mut self,
        frame: &mut Frame<'_>,
        plan: &mut FramePlan,
    ) -> anyhow::Result<()> {
        self.wanted.clear();
        for caster in &mut plan.casters {
            self.wanted.push(std::mem::take(&mut caster.is_drawn));
        }
        let resources = frame.resources();
        let (look, depth) = (VolumeLook::new(resources), resources.depth_buffer());
        let drawn = frame.stage(OCCLUSION_STAGE, |stage| {
            let drawn = self.culler.begin(stage, &look)?;
            self.culler.ask(stage, &depth, &look)?;
            anyhow::Ok(drawn)
        })?;
        for caster in drawn {
            let caster = caster as usize;
            plan.casters[caster].is_drawn = self.wanted[caster];
        }
        Ok(())
    }

    /// Waits for what was asked; gives the casters that turn out to be visible, and asks about more. `None` once nothing is
    /// open any more; what was drawn without asking is then asked about for later frames.
    pub(super) fn go_on(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<Option<Vec<u32>>> {
        let resources = frame.resources();
        let (look, depth) = (VolumeLook::new(resources), resources.depth_buffer());
        frame.stage(OCCLUSION_STAGE, |stage| {
            let Some(mut visible) = self.culler.go_on(stage, &look)? else {
                self.culler.end(stage, &depth, &look)?;
                return Ok(None);
            };
            visible.retain(|caster| self.wanted[*caster as usize]);
            self.culler.ask(stage, &depth, &look)?;
            Ok(Some(visible))
        })
    }

    /// All that a frame asks about, answered before anything is drawn.
    pub(super) fn cull(
        &mut self,
        frame: &mut Frame<'_>,
        plan: &mut FramePlan,
    ) -> anyhow::Result<()> {
        self.begin(frame, plan)?;
        while let Some(visible) = self.go_on(frame)? {
            for caster in visible {
                plan.casters[caster as usize].is_drawn = true;
            }
        }
        self.end(plan);
        Ok(())
    }

    /// Once all is known: what was asked and hidden.
    pub(super) fn end(&self, plan: &mut FramePlan) {
        plan.queries = self.culler.asked();
        let casters = plan.casters.iter().zip(&self.wanted);
        let hidden = casters.filter(|(caster, is_wanted)| **is_wanted && !caster.is_drawn);
        plan.hidden = hidden.count() as u32;
    }
}
