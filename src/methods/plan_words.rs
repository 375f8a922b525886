//! How the volumes of casters are drawn, for the device.

use super::capping::CappedPlan;
use crate::geometry::Casting;

/// The plan of a caster in a word: whether it is drawn (bit 0) and counted z-pass (1), what casts (2 and 3), whether its caps are
/// fans, in front (4) and behind (5), whether its far ends meet (6), and the number of its end plane, plus 1 (from 8 on).
/// Twin of `Plan` in `shaders/methods/silhouette/plans.wgsl`.
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
