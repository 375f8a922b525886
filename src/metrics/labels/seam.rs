//! Seams: single pixels on an edge between two triangles that go on alike.
//!
//! Volumes of single triangles leave each other out along their common side quads, one quad for each
//! triangle. Near the edge both quads are as near to the surface as can be, and clipping or tessellation that
//! gives them another last bit leaves one of them at a pixel.

use super::frame::Frame;
use crate::metrics::regions::Artifact;

/// A region of more pixels is something else.
const MOST_PX: usize = 2;

/// An edge that leaves the picture is clipped, and its new ends are moved to the rasteriser's grid once more,
/// for the surface as for each quad: so many steps apart they may come to lie.
pub const SEAM_STEPS: f64 = 4.0;

/// Whether all pixels of a region have such an edge at their centre.
pub(super) fn is_seam(frame: &Frame<'_>, artifact: &Artifact) -> bool {
    let mut pixels = artifact.pixels.iter();
    artifact.pixels.len() <= MOST_PX
        && pixels.all(|pixel| frame.probe.at_inner_edge(*pixel, SEAM_STEPS))
}
