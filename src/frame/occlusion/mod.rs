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
mod tree;

pub use box_queries::BoxQueries;
pub use coherence::{Coherence, Frontier, Sight};
pub use tree::BoxTree;
