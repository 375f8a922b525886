//! Silhouette edges on the processor: which edges bound a shadow volume for a light, and how often.
//!
//! An edge is on the silhouette if the facings of the triangles on it, all taken along the edge, do not cancel: their sum
//! is its *multiplicity*. [`brute_force`] asks every edge. The trees ask few of them and find the same: a [`PlaneTree`]
//! groups edges by the planes of their triangles, a [`Hextree`] is that of Wallner 2006.

mod hextree;
mod plane_tree;
mod planes;

use super::{Edge, Topology, facing};
use crate::scene::mesh::Mesh;
use glam::Vec4;
use rayon::prelude::*;

pub use hextree::{DEPTH as HEXTREE_DEPTH, Hextree};
pub use plane_tree::PlaneTree;

/// An edge on the silhouette.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SilhouetteEdge {
    /// Its place in [`Topology::edges`].
    pub edge: u32,
    /// The sum of the facings of its triangles, each taken as `a`, `b`, opposite vertex; not 0.
    pub multiplicity: i32,
}

/// Edges that one task asks at a time.
const EDGES_PER_TASK: usize = 4096;

/// The multiplicity of an edge, see [`SilhouetteEdge`]. `light` is homogeneous, as in [`facing()`](fn@facing).
pub fn multiplicity(mesh: &Mesh, topology: &Topology, edge: Edge, light: Vec4) -> i32 {
    let [a, b] = [edge.a, edge.b].map(|vertex| mesh.positions[vertex as usize]);
    let opposites = topology.opposites_of(edge).iter();
    opposites
        .map(|&opposite| facing(a, b, mesh.positions[opposite as usize], light))
        .sum()
}

/// Asks every edge; the silhouette in ascending order of the edges.
pub fn brute_force(mesh: &Mesh, topology: &Topology, light: Vec4) -> Vec<SilhouetteEdge> {
    let edges = 0..topology.edges.len() as u32;
    edges
        .into_par_iter()
        .with_min_len(EDGES_PER_TASK)
        .filter_map(|edge| ask(mesh, topology, edge, light))
        .collect()
}

fn ask(mesh: &Mesh, topology: &Topology, edge: u32, light: Vec4) -> Option<SilhouetteEdge> {
    let multiplicity = multiplicity(mesh, topology, topology.edges[edge as usize], light);
    (multiplicity != 0).then_some(SilhouetteEdge { edge, multiplicity })
}

#[cfg(test)]
mod tests;
