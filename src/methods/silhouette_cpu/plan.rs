//! How the volume of each caster is drawn in a frame.

use super::faces::Faces;
use super::{Caps, Casting};
use crate::frame::FrameView;
use crate::geometry::Bounds;
use crate::geometry::end_plane::AT_INFINITY;
use crate::methods::volume_parameters::{Counting, FrontCap, Reach, VolumeParameters};

/// How the volume of one caster is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct CasterPlan {
    pub(super) z_pass: bool,
    pub(super) casting: Casting,
    /// Whether its front cap is a fan. It covers what the cap covers where nothing of either is clipped.
    pub(super) fan_in_front: bool,
    /// Whether its back cap is a fan. That covers what the cap covers on a plane; at infinity, a cap around the light
    /// is a sphere, and what has the same edges may lack all of it.
    pub(super) fan_behind: bool,
}

/// What plans depend on besides the frame.
pub(super) struct Planner {
    pub(super) volume: VolumeParameters,
    pub(super) casting: Casting,
    pub(super) caps: Caps,
    /// For each caster whether it is closed and wound consistently.
    pub(super) closed: Vec<bool>,
}

impl Planner {
    /// A plan for each caster, given the boxes around them.
    pub(super) fn plans(&self, view: &FrameView, casters: &[Bounds]) -> Vec<CasterPlan> {
        let near_volume = view.near_volume();
        let near_rectangle = view.near_rectangle();
        let light = view.light.place;
        let at = light.truncate().as_dvec3();
        let lamp = (light.w != 0.0).then_some(Bounds { low: at, high: at });
        let plan = |(&bounds, &closed): (&Bounds, &bool)| {
            let z_pass = match self.volume.counting {
                Counting::ZFail => false,
                Counting::ZPass => true,
                Counting::Auto => !near_volume.may_meet(bounds),
            };
            // Seen from outside, and from a light outside, a closed surface has as many triangles that face the light
            // before a point as others: it is in shadow if there is one of the former. A point that is visible without
            // looking through the surface is outside, too, where the near rectangle is.
            let is_outside_of_lamp = || lamp.is_none_or(|lamp| !bounds.may_meet(lamp));
            let is_outside = || !bounds.may_meet(near_rectangle) && is_outside_of_lamp();
            let casting = match self.casting {
                Casting::LightFacing if closed && is_outside() => Casting::LightFacing,
                _ => Casting::All,
            };
            // A fan has as many triangles as the silhouette edges, few where a surface is closed.
            let fans = !z_pass && self.caps == Caps::Fan && closed;
            let is_far = self.volume.front_cap == FrontCap::Far;
            CasterPlan {
                z_pass,
                casting,
                fan_in_front: fans && is_far && view.is_beyond_near_plane(bounds),
                fan_behind: fans && (self.ends_on_plane(view) || is_outside_of_lamp()),
            }
        };
        casters.iter().zip(&self.closed).map(plan).collect()
    }

    /// Whether volumes end on a plane in a frame, and not at infinity.
    pub(super) fn ends_on_plane(&self, view: &FrameView) -> bool {
        self.volume.reach == Reach::Scene && view.end_plane != AT_INFINITY
    }

    /// The caps of one triangle, but for those that are fans.
    pub(super) fn cap(&self, faces: &mut Faces, plan: CasterPlan, [a, b, c]: [u32; 3], facing: i8) {
        let casts = facing == 1 || facing == -1 && plan.casting == Casting::All;
        // Counter-clockwise seen from the light.
        let triangle = if facing == 1 { [a, b, c] } else { [a, c, b] };
        if casts && !plan.fan_in_front {
            faces.front_cap(triangle, self.volume.front_cap == FrontCap::Far);
        }
        let are_others_behind =
            self.caps == Caps::FarTriangles && plan.casting == Casting::LightFacing;
        if casts != are_others_behind && !plan.fan_behind {
            faces.back_cap(triangle);
        }
    }
}

impl CasterPlan {
    /// Whether a cap of it is made of triangles.
    pub(super) fn has_triangles(self) -> bool {
        !(self.z_pass || self.fan_in_front && self.fan_behind)
    }
}
