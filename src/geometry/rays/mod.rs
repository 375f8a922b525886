//! Shadow rays: from what a pixel shows to the light, against all that casts.
//!
//! All methods that trace rays use the same tree ([`RayTree`]), the same points of surfaces and the same watertight
//! test ([`Blocker`]), each in its own language.

mod beam;
mod blocks;
mod packet;
mod picture;
mod shadows;
mod sight;
mod tree;
mod triangle;
mod vectors;

pub use blocks::{Blocker, SurfacePoint};
pub use picture::Picture;
pub use tree::{Node, RayTree, boxes, casters};
pub use triangle::RayTriangle;

#[cfg(test)]
mod tests;
