//! What is derived from a mesh and does not change from frame to frame, and which side of a
//! triangle the light is on.

pub mod facing;
pub mod topology;

pub use facing::{facing, vertex_less};
pub use topology::{Edge, EdgeCounts, Topology};
