//! What is derived from a mesh, a light and an eye: topology, facing, and how far shadow volumes need
//! to reach.

pub mod bounds;
pub mod box_tree;
pub mod casting;
pub mod disjoint_sets;
pub mod edge_triangles;
pub mod end_plane;
pub mod extruded_box;
pub mod facing;
pub mod near_count;
pub mod near_volume;
pub mod occluded;
pub mod open_edges;
mod ray;
pub mod rays;
pub mod silhouette;
pub mod topology;

pub use bounds::Bounds;
pub use casting::Casting;
pub use disjoint_sets::DisjointSets;
pub use edge_triangles::{EdgeTriangle, EdgeTriangles};
pub use end_plane::{EndPlane, EndPlanes};
pub use extruded_box::VisibleFaces;
pub use facing::{Determinism, facing, vertex_less};
pub use near_count::{NearCount, NearCounts, NearRay};
pub use near_volume::NearVolume;
pub use open_edges::OpenEdges;
pub use topology::{Edge, EdgeCounts, Topology};
