//! Seams: single pixels on an edge between two triangles that go on alike.
//!
//! Volumes of single triangles cancel along their common side quads, one quad for each
//! triangle. Near the edge both quads are as near to the surface as can be, and clipping or tessellation that
//! gives them another last bit leaves one of them at a pixel.

use super::frame::JudgedFrame;
use crate::metrics::regions::Artifact;

/// A region of more pixels is something else.
const MAX_PX: usize = 2;

/// How far from the centre, in steps of the rasteriser's grid: a sixteenth of a pixel, which is as coarse as the
/// grid may be in Vulkan. Clipped edges are moved to it once more, and a push back moves the quads of both
/// triangles by amounts of their own.
pub const SEAM_STEPS: f64 = 16.0;

/// Whether all pixels of a region have such an edge at their centre.
pub(super) fn is_seam(frame: &JudgedFrame<'_>, artifact: &Artifact) -> bool {
    let mut pixels = artifact.pixels.iter();
    artifact.pixels.len() <= MAX_PX
        && pixels.all(|pixel| frame.probe.at_inner_edge(*pixel, SEAM_STEPS))
}
