//! How the caps of each caster's volume are drawn in a frame.

use super::PrepareContext;
use super::occlusion::Occlusion;
use super::plan::{CasterPlan, FramePlan, Planner};
use super::volume_parameters::{FrontCap, VolumeParameters};
use super::volumes::CHOOSE_STAGE;
use crate::frame::{Frame, FrameView};
use crate::geometry::{Bounds, Casting, Determinism, DisjointSets, EndPlane, Topology};
use crate::scene::Mesh;
use serde::{Deserialize, Serialize};

/// What caps are made of.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Caps {
    /// Of closed objects, fans over the silhouette wherever these cover the same; else triangles.
    #[default]
    Fan,
    /// The triangles that cast, and the same at their far ends.
    Triangles,
    /// In front the triangles that cast; behind, where only those cast that face the light, all the others at their
    /// far ends.
    FarTriangles,
}

/// How the volume of one caster is drawn, and its caps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CappedPlan {
    pub(super) caster: CasterPlan,
    /// Whether its front cap is a fan. It covers what the cap covers where nothing of either is clipped.
    pub(super) fan_in_front: bool,
    /// Whether its back cap is a fan. That covers what the cap covers on a plane; at infinity, a cap around the light
    /// is a sphere, and what has the same edges may lack all of it.
    pub(super) fan_behind: bool,
    /// All far ends are one point: volumes of a light at infinity that reach to infinity need no back caps.
    pub(super) far_ends_meet: bool,
}

/// What caps depend on besides the plan.
pub(super) struct Capping {
    pub(super) front_cap: FrontCap,
    pub(super) caps: Caps,
    /// For each caster whether it is closed and wound consistently.
    pub(super) closed: Vec<bool>,
}

/// Plans volumes and their caps.
pub(super) struct CappedPlanner {
    planner: Planner,
    pub(super) capping: Capping,
    occlusion: Option<Occlusion>,
}

impl CappedPlanner {
    /// A planner for volumes of these parameters.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: VolumeParameters,
        casting: Casting,
        capping: Capping,
    ) -> Self {
        Self {
            planner: Planner::new(context, parameters, casting, Determinism::default()),
            capping,
            occlusion: Occlusion::wanted(context, parameters),
        }
    }

    /// The next frame does not follow the one before.
    pub(super) fn begin(&mut self) {
        if let Some(occlusion) = &mut self.occlusion {
            occlusion.forget();
        }
    }

    /// Records the stages that plan a frame.
    ///
    /// # Errors
    /// When the device is lost.
    pub(super) fn choose(
        &mut self,
        frame: &mut Frame<'_>,
    ) -> anyhow::Result<(FramePlan, Vec<CappedPlan>)> {
        let (view, casters) = (*frame.view(), &frame.resources().extents.casters);
        let mut plan = frame.stage(CHOOSE_STAGE, |stage| {
            stage.on_processor(|| self.planner.plan(&view, casters))
        });
        if let Some(occlusion) = &mut self.occlusion {
            occlusion.cull(frame, &mut plan)?;
        }
        let plans = frame.stage(CHOOSE_STAGE, |stage| {
            stage.on_processor(|| self.capping.plans(&plan.casters, &view, casters))
        });
        Ok((plan, plans))
    }
}

impl Capping {
    /// Adds the caps to the plans of all casters, given the boxes around these.
    fn plans(&self, plans: &[CasterPlan], view: &FrameView, casters: &[Bounds]) -> Vec<CappedPlan> {
        let capped = |((plan, bounds), closed): ((&CasterPlan, &Bounds), &bool)| {
            self.plan(*plan, *closed, view, *bounds)
        };
        let casters = plans.iter().zip(casters).zip(&self.closed);
        casters.map(capped).collect()
    }

    fn plan(
        &self,
        caster: CasterPlan,
        is_closed: bool,
        view: &FrameView,
        bounds: Bounds,
    ) -> CappedPlan {
        // A fan has as many triangles as the silhouette edges, few where a surface is closed.
        let fans = !caster.z_pass && self.caps == Caps::Fan && is_closed;
        let is_far = self.front_cap == FrontCap::Far;
        let ends_on_plane = caster.end != EndPlane::INFINITY;
        CappedPlan {
            caster,
            fan_in_front: fans && is_far && view.is_beyond_near_plane(bounds),
            fan_behind: fans && (ends_on_plane || view.is_outside_of_lamp(bounds)),
            far_ends_meet: !ends_on_plane && view.light.place.w == 0.0,
        }
    }
}

impl CappedPlan {
    /// Whether a cap of it is made of triangles.
    pub(super) fn has_triangles(self) -> bool {
        let has_caps = self.caster.is_drawn && !self.caster.z_pass;
        has_caps && !(self.fan_in_front && self.fan_behind)
    }
}

/// For each vertex one of the same connected part of its object: where fans of that part meet.
pub(super) fn fan_apexes(mesh: &Mesh, topology: &Topology) -> Vec<u32> {
    let mut parts = DisjointSets::new(mesh.positions.len() as u32);
    for edge in &topology.edges {
        parts.join(edge.a, edge.b);
    }
    (0..mesh.positions.len() as u32)
        .map(|vertex| parts.smallest(vertex))
        .collect()
}
