//! Grazing: on surfaces that the light sees edge-on but for a little.
//!
//! The shadow volume of such a surface is thinner than the depth buffer can tell, so that its sides may
//! come out before the very surface that they start from.

use super::frame::Frame;
use crate::metrics::regions::Artifact;

/// Sine of the angle between surface and light, below which a volume is thinner than 32 bits of depth can
/// tell: a hundred times their last bit, for the error of the planes that depth is taken from.
const GRAZING_SINE: f64 = 1e-4;

/// Whether the light sees the surface edge-on at all pixels of a region.
pub(super) fn is_grazing(frame: &Frame<'_>, artifact: &Artifact) -> bool {
    artifact
        .pixels
        .iter()
        .filter_map(|pixel| frame.probe.light_sine(*pixel))
        .all(|sine| sine < GRAZING_SINE)
}
