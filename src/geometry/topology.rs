//! The edges of a mesh, each with the third vertex of every triangle on it.
//!
//! Nothing is asked of the mesh: an edge may have one opposite vertex or hundreds. Edges are found
//! by bucketing the half-edges by their smaller vertex and sorting each small bucket. The work is
//! cut into stripes of the *vertex* range: a stripe owns all half-edges of its vertices, so stripes
//! share nothing, and one huge object is spread over the cores as well as thousands of small ones.
//! The result does not depend on the number of stripes.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use crate::scene::mesh::Mesh;

/// More stripes than threads even out objects of different kinds; but each stripe that meets an
/// object reads all its triangles, so not many more.
const STRIPES_PER_THREAD: usize = 2;

/// An edge of one object, from its smaller to its larger vertex index.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct Edge {
    /// The smaller vertex index.
    pub a: u32,
    /// The larger vertex index.
    pub b: u32,
    /// Where its opposite vertices begin in [`Topology::opposites`].
    pub first_opposite: u32,
    /// How many opposite vertices it has: one for each triangle on it, at least one.
    pub opposite_count: u32,
}

/// All edges of the objects that cast a shadow.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Topology {
    /// The edges, in ascending order of (a, b).
    pub edges: Vec<Edge>,
    /// The opposite vertices of all edges, edge after edge, ascending within one.
    pub opposites: Vec<u32>,
    /// The edges of each object of the mesh; empty for one that casts no shadow.
    pub object_edges: Vec<Range<u32>>,
}

/// How many edges there are of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EdgeCounts {
    /// Edges with one opposite vertex.
    pub boundary: usize,
    /// Edges with two.
    pub manifold: usize,
    /// Edges with more.
    pub non_manifold: usize,
}

impl EdgeCounts {
    /// True if every edge has two opposite vertices: the casters enclose volumes.
    pub fn is_closed_manifold(self) -> bool {
        self.boundary == 0 && self.non_manifold == 0
    }
}

impl Topology {
    /// Finds the edges of every object that casts a shadow.
    ///
    /// A triangle that names a vertex twice is left out: its facing is 0 for every light, so it
    /// would add nothing to any edge.
    pub fn build(mesh: &Mesh) -> Self {
        let stripe_count = rayon::current_num_threads() * STRIPES_PER_THREAD;
        Self::build_in_stripes(mesh, stripe_count)
    }

    fn build_in_stripes(mesh: &Mesh, stripe_count: usize) -> Self {
        let stripe_len = mesh.positions.len().div_ceil(stripe_count).max(1);
        let stripes: Vec<Stripe> = (0..mesh.positions.len())
            .into_par_iter()
            .step_by(stripe_len)
            .map(|start| start as u32..(start + stripe_len).min(mesh.positions.len()) as u32)
            .map(|vertices| Stripe::build(mesh, &vertices))
            .collect();

        let mut edges = Vec::with_capacity(stripes.iter().map(|s| s.edges.len()).sum());
        let mut opposites = Vec::with_capacity(stripes.iter().map(|s| s.half_edges.len()).sum());
        for stripe in &stripes {
            let base = opposites.len() as u32;
            edges.extend(stripe.edges.iter().map(|e| Edge {
                first_opposite: base + e.first_opposite,
                ..*e
            }));
            opposites.extend(stripe.half_edges.iter().map(|h| h.opposite()));
        }
        let object_edges = mesh
            .objects
            .par_iter()
            .map(|o| edges_from(&edges, &o.vertices))
            .collect();
        Self {
            edges,
            opposites,
            object_edges,
        }
    }

    /// The opposite vertices of an edge.
    pub fn opposites_of(&self, edge: Edge) -> &[u32] {
        let first = edge.first_opposite as usize;
        &self.opposites[first..first + edge.opposite_count as usize]
    }

    /// Counts the edges by kind.
    pub fn counts(&self) -> EdgeCounts {
        let mut counts = EdgeCounts::default();
        for edge in &self.edges {
            match edge.opposite_count {
                1 => counts.boundary += 1,
                2 => counts.manifold += 1,
                _ => counts.non_manifold += 1,
            }
        }
        counts
    }
}

/// The edges whose smaller vertex is in `vertices`, which makes them those of one object.
fn edges_from(edges: &[Edge], vertices: &Range<u32>) -> Range<u32> {
    let first_from = |vertex| edges.partition_point(|edge| edge.a < vertex) as u32;
    first_from(vertices.start)..first_from(vertices.end)
}

/// A half-edge in the bucket of its smaller vertex: the larger vertex in the high half and the
/// opposite one in the low half, so that sorting brings equal edges together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct HalfEdge(u64);

impl HalfEdge {
    fn new(b: u32, opposite: u32) -> Self {
        Self(u64::from(b) << 32 | u64::from(opposite))
    }

    fn b(self) -> u32 {
        (self.0 >> 32) as u32
    }

    fn opposite(self) -> u32 {
        self.0 as u32
    }
}

/// The edges whose smaller vertex lies in one range of vertices.
struct Stripe {
    /// Sorted; `first_opposite` counts from the start of `half_edges`.
    edges: Vec<Edge>,
    half_edges: Vec<HalfEdge>,
}

impl Stripe {
    fn build(mesh: &Mesh, vertices: &Range<u32>) -> Self {
        // How large each bucket is, then where it starts, then where its next half-edge goes.
        let mut counts = vec![0u32; vertices.len()];
        for_each_half_edge(mesh, vertices, |a, _| counts[a] += 1);
        let mut total = 0;
        let mut cursors = counts;
        for cursor in &mut cursors {
            total += std::mem::replace(cursor, total);
        }
        let mut half_edges = vec![HalfEdge(0); total as usize];
        for_each_half_edge(mesh, vertices, |a, half_edge| {
            half_edges[cursors[a] as usize] = half_edge;
            cursors[a] += 1;
        });

        // Filling moved each cursor to the end of its bucket.
        let mut edges = Vec::with_capacity(half_edges.len() / 2);
        let mut start = 0;
        for (a, &end) in (vertices.start..).zip(&cursors) {
            let bucket = &mut half_edges[start as usize..end as usize];
            bucket.sort_unstable();
            for run in bucket.chunk_by(|left, right| left.b() == right.b()) {
                let opposite_count = run.len() as u32;
                edges.push(Edge {
                    a,
                    b: run[0].b(),
                    first_opposite: start,
                    opposite_count,
                });
                start += opposite_count;
            }
        }
        Self { edges, half_edges }
    }
}

/// Calls `visit` with every half-edge of a caster whose smaller vertex lies in `vertices`; that
/// vertex counts from the start of the range.
fn for_each_half_edge(mesh: &Mesh, vertices: &Range<u32>, mut visit: impl FnMut(usize, HalfEdge)) {
    let meets = |other: &Range<u32>| other.start < vertices.end && vertices.start < other.end;
    for object in mesh.casters().filter(|object| meets(&object.vertices)) {
        for &[a, b, c] in &mesh.triangles[object.triangle_range()] {
            if a == b || b == c || c == a {
                continue;
            }
            for (from, to, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
                let (small, large) = (from.min(to), from.max(to));
                // Below the range this wraps to a large number.
                let bucket = small.wrapping_sub(vertices.start) as usize;
                if bucket < vertices.len() {
                    visit(bucket, HalfEdge::new(large, opposite));
                }
            }
        }
    }
}

#[cfg(test)]
#[path = "topology_tests.rs"]
mod tests;
