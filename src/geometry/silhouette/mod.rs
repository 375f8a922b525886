//! Silhouette edges on the processor: which edges bound a shadow volume for a light, and how often.
//!
//! An edge is on the silhouette if the facings of the triangles on it, all taken along the edge, do not cancel: their sum
//! is its *multiplicity*. [`BruteForce`] finds the facings of all triangles and asks every edge. The trees ask few edges
//! and find the same: a [`PlaneTree`] groups edges by the planes of their triangles, a [`Hextree`] is that of Wallner
//! 2006.

mod brute_force;
mod clusters;
mod edge_block;
mod facings;
mod hextree;
mod lanes;
mod large_pages;
mod plane_tree;
mod planes;
mod steps;

use super::{Topology, facing};
use crate::scene::mesh::Mesh;
use glam::Vec4;
use rayon::prelude::*;

pub use brute_force::BruteForce;
pub use clusters::{ClusterBox, ClusterLight, EdgeClusters};
pub use facings::Facings;
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

/// Which edges are on the silhouette of this mesh under this light.
#[derive(Clone, Copy)]
struct Question<'a> {
    mesh: &'a Mesh,
    topology: &'a Topology,
    light: Vec4,
}

impl Question<'_> {
    /// The multiplicity of an edge, by the facings of its triangles.
    fn multiplicity(&self, edge: u32) -> i32 {
        let Self {
            mesh,
            topology,
            light,
        } = self;
        let edge = topology.edges[edge as usize];
        let at = |vertex: u32| mesh.positions[vertex as usize];
        let (a, b) = (at(edge.a), at(edge.b));
        let facing = |opposite: &u32| facing(a, b, at(*opposite), *light);
        topology.opposites_of(edge).iter().map(facing).sum()
    }

    fn ask(&self, edge: u32) -> Option<SilhouetteEdge> {
        let multiplicity = self.multiplicity(edge);
        (multiplicity != 0).then_some(SilhouetteEdge { edge, multiplicity })
    }
}

/// What one core asks of blocks before it is worth while to wake another.
const BLOCKS_PER_TASK: usize = 16384;

/// The same of edges.
const EDGES_PER_TASK: usize = 4096;

/// Adds what `find` finds in parts of a mesh, so many at a time, in their order. It is told the place of the first.
fn in_parallel<T: Sync>(
    parts: &[T],
    at_a_time: usize,
    found: &mut Vec<SilhouetteEdge>,
    find: impl Fn(usize, &[T], &mut Vec<SilhouetteEdge>) + Sync,
) {
    if parts.len() <= at_a_time {
        return find(0, parts, found);
    }
    let tasks = parts.par_chunks(at_a_time).enumerate();
    let by_thread = tasks.fold(Vec::new, |mut found, (task, parts)| {
        find(task * at_a_time, parts, &mut found);
        found
    });
    let by_thread: Vec<_> = by_thread.collect();
    for mut more in by_thread {
        found.append(&mut more);
    }
}

#[cfg(test)]
mod tests;
