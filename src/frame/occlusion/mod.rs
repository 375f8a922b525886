//! What cannot be seen is found out by boxes and need not be drawn: hierarchical occlusion culling, of objects or of their
//! shadow volumes.
//!
//! Boxes of a tree over objects are drawn against the depth buffer, and the device counts the samples that pass (occlusion
//! queries). Bittner, Wimmer, Piringer and Purgathofer 2004 and Wimmer and Bittner 2005 ask no more than they must, as what
//! was visible in the last frame mostly still is; Stich, Wächter and Keller 2007 do so for shadow volumes, with boxes that are
//! extruded from the light.
//!
//! What was visible is drawn without asking, and asked about from time to time, for later frames; what was not is
//! asked about in the frame itself, before it is left out. So an answer that comes late costs time at most.

mod box_queries;
mod coherence;
mod culler;
mod tree;

pub use box_queries::{BoxQueries, DepthBuffer};
pub use coherence::{Coherence, Frontier, Sight};
pub use culler::{Culler, Look};
pub use tree::BoxTree;

use super::{FrameView, SceneExtents};

/// Boxes are larger on every side by what so much of a pixel is at the farthest point of the scene: more than the
/// rasteriser moves the edges of either.
const MARGIN_PX: f64 = 1.0 / 16.0;

/// And by this part of the largest coordinate, more than rounding.
const ROUNDING: f64 = 1e-5;

/// How much larger boxes are on every side than what they contain, lest they miss a pixel that it covers, in pictures so
/// many pixels high.
pub fn margin(view: &FrameView, extents: &SceneExtents, height_px: u32) -> f64 {
    let (scene, eye) = (extents.scene, view.eye.as_dvec3());
    let farthest = (scene.low - eye)
        .abs()
        .max((scene.high - eye).abs())
        .length();
    let half_height = view.clip_to_eye_ray.y_axis.as_dvec4().truncate().length();
    let largest = scene.low.abs().max(scene.high.abs()).max_element();
    MARGIN_PX * farthest * 2.0 * half_height / f64::from(height_px) + ROUNDING * largest
}
