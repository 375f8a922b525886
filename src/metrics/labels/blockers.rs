//! Rules that look at what stands between false-lit pixels and the light.

use super::frame::JudgedFrame;
use crate::reference::Evidence;

/// Overflow: an 8-bit stencil counter holds one less than this.
const COUNTER_RANGE: u32 = 256;

/// Overflow: at least this share of the pixels is behind that many casting triangles.
const OVERFLOW_SHARE: f64 = 0.9;

/// Uncovered: at least this share of the pixels is outside of the map.
const UNCOVERED_SHARE: f64 = 0.9;

/// Detached shadow: at its closest, the region is at most this many scales from what casts the
/// shadow. The scale is the width of a pixel or of the map's texel, whichever is larger.
const DETACHED_CLOSEST_SCALES: f64 = 4.0;

/// Detached shadow: most of the region is at most this many scales from what casts the shadow. A
/// slope bias of 2 texels, on a surface that the light meets at an angle of 14 degrees, opens a gap of 8.
const DETACHED_SCALES: f64 = 8.0;

/// Detached shadow: this share of the pixels is most.
const DETACHED_SHARE: f64 = 0.75;

/// Detached shadow: fewer pixels are no band.
const DETACHED_MIN_PX: usize = 4;

/// At most this many pixels of a region are looked at, fewer where there are many regions.
const SAMPLES_A_REGION: usize = 256;
const SAMPLES_A_FRAME: usize = 16_384;

/// How many pixels of each region are looked at.
pub(super) fn samples_a_region(regions: usize) -> usize {
    (SAMPLES_A_FRAME / regions.max(1)).clamp(DETACHED_MIN_PX, SAMPLES_A_REGION)
}

/// Whether so many shadows overlap here that an 8-bit counter cannot tell them from fewer.
pub(super) fn is_overflow(frame: &JudgedFrame<'_>, evidence: &[Evidence]) -> bool {
    // A shadow map counts nothing.
    if frame.texel.is_some() {
        return false;
    }
    let past = evidence.iter().filter(|e| e.blockers >= COUNTER_RANGE);
    !evidence.is_empty() && past.count() as f64 >= OVERFLOW_SHARE * evidence.len() as f64
}

/// Whether the shadow map has no texel here that could say what stands before the light.
pub(super) fn is_uncovered(frame: &JudgedFrame<'_>, evidence: &[Evidence]) -> bool {
    let Some(texel) = frame.texel else {
        return false;
    };
    let outside = evidence.iter().filter(|e| texel(e.point).is_none());
    !evidence.is_empty() && outside.count() as f64 >= UNCOVERED_SHARE * evidence.len() as f64
}

/// Whether the light shines through between a caster and the beginning of its shadow.
pub(super) fn is_detached(frame: &JudgedFrame<'_>, evidence: &[Evidence]) -> bool {
    if evidence.len() < DETACHED_MIN_PX {
        return false;
    }
    let scales = |e: &Evidence| {
        let texel = frame.texel_size(e.point, e.px_size).unwrap_or(0.0);
        let distance = e.nearest_blocker.unwrap_or(f64::INFINITY);
        distance / texel.max(e.px_size)
    };
    let distances: Vec<f64> = evidence.iter().map(scales).collect();
    let near = distances.iter().filter(|&&d| d <= DETACHED_SCALES).count();
    distances.iter().any(|&d| d <= DETACHED_CLOSEST_SCALES)
        && near as f64 >= DETACHED_SHARE * distances.len() as f64
}
