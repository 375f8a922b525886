//! Grazing: on surfaces that the light sees edge-on but for a little.
//!
//! The shadow volume of such a surface is thinner than the depth buffer can tell, so that its sides may
//! come out before the very surface that they start from.

use super::frame::JudgedFrame;
use crate::metrics::regions::Artifact;

/// Sine of the angle between surface and light below which that happens. Depth is taken from planes that are
/// hundreds of pixels wide, and long and thin: they are uncertain by up to some thousand times its last bit, which is
/// 6e-8 of it.
const GRAZING_SINE: f64 = 1e-3;

/// Whether the light sees the surface edge-on at all pixels of a region.
pub(super) fn is_grazing(frame: &JudgedFrame<'_>, artifact: &Artifact) -> bool {
    let is_grazing = |pixel: &usize| {
        let sine = frame.probe.light_sine(*pixel);
        sine.is_some_and(|sine| sine < GRAZING_SINE)
    };
    artifact.pixels.iter().all(is_grazing)
}
