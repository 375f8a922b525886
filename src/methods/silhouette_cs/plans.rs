//! How the volumes of casters are drawn, for the device.

use crate::geometry::Casting;
use crate::methods::capping::CappedPlan;

/// The plan of a caster in a word. Twin of `Plan` in `shaders/methods/silhouette_cs/blocks.wgsl`.
pub(super) fn word(plan: CappedPlan) -> u32 {
    let CappedPlan {
        caster,
        fan_in_front,
        fan_behind,
        far_ends_meet,
    } = plan;
    let casting = match caster.casting {
        Casting::All => 0,
        Casting::LightFacing => 1,
        Casting::EachSide => 2,
    };
    u32::from(caster.is_drawn)
        | u32::from(caster.z_pass) << 1
        | casting << 2
        | u32::from(fan_in_front) << 4
        | u32::from(fan_behind) << 5
        | u32::from(far_ends_meet) << 6
        | (caster.end.index() as u32 + 1) << 8
}
