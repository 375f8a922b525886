//! Edges in the forms in which shaders take them.

use crate::geometry::{Determinism, Edge, EdgeTriangle, EdgeTriangles, Topology, vertex_less};
use crate::scene::Mesh;
use glam::{Vec3, Vec4};
use std::cmp::Ordering;
use std::ops::Range;

/// Edges with end points in the vertex order, and at most so many opposite vertices. An edge with more
/// is split into several with the same end points; multiplicities add up, so the shadow stays the same.
///
/// Its opposite vertices are dealt out in turn, in the vertex order: those that are near to each other, copies
/// above all, come to different parts. So facings cancel within a part, where they leave nothing, rather than
/// between the side quads of two, where the tessellator's last bit may leave a pixel.
pub(super) struct EdgeRecords {
    pub(super) edges: Vec<Edge>,
    /// The opposite vertices of the records: those of the topology, and then those of edges that were
    /// split, dealt out.
    pub(super) opposites: Vec<u32>,
    /// The records of each object that casts, in drawing order.
    pub(super) objects: Vec<Range<u32>>,
    /// The edges that were split, as they were.
    split: Vec<Edge>,
    limit: u32,
}

impl EdgeRecords {
    /// With `triangles`, opposite vertices are dealt out such that every first one in a record is of a triangle that goes
    /// from its a to its b, and every second one of a triangle that goes back; where there are more of one kind, the
    /// end a stands for what lacks, and adds nothing. So records have room for two at least.
    pub(super) fn new(
        mesh: &Mesh,
        topology: &Topology,
        triangles: Option<&EdgeTriangles>,
        limit: u32,
    ) -> Self {
        let limit = match triangles {
            Some(_) => (limit & !1).max(2),
            None => limit,
        };
        let mut records = Self {
            edges: Vec::with_capacity(topology.edges.len()),
            split: Vec::new(),
            opposites: match triangles {
                Some(_) => Vec::with_capacity(topology.opposites.len()),
                None => topology.opposites.clone(),
            },
            objects: Vec::with_capacity(topology.object_edges.len()),
            limit,
        };
        let casters = mesh.objects.iter().zip(&topology.object_edges);
        for (_, range) in casters.filter(|(object, _)| object.casts_shadow) {
            let start = records.edges.len() as u32;
            for &edge in &topology.edges[range.start as usize..range.end as usize] {
                let triangles = triangles.map(|triangles| triangles.of(edge));
                let edge = records.taken(mesh, topology, edge, triangles);
                if edge.opposite_count <= limit {
                    records.edges.push(edge);
                } else {
                    records.edges.extend(parts(edge, limit));
                    records.split.push(edge);
                }
            }
            records.objects.push(start..records.edges.len() as u32);
        }
        records
    }

    /// The records of each edge of the topology, given the edges of each object that casts, in drawing order.
    pub(super) fn of_edges(&self, topology: &Topology, casters: &[Range<u32>]) -> Vec<Range<u32>> {
        let mut of_edges = vec![0..0; topology.edges.len()];
        for (edges, records) in casters.iter().zip(&self.objects) {
            let mut first = records.start;
            let numbers = edges.start as usize..edges.end as usize;
            for (edge, found) in topology.edges[numbers.clone()]
                .iter()
                .zip(&mut of_edges[numbers])
            {
                // Parts of an edge, and nothing else in an object, have the same ends.
                let own = self.edges[first as usize..records.end as usize].iter();
                let ends = |edge: &Edge| (edge.a.min(edge.b), edge.a.max(edge.b));
                let parts = own.take_while(|record| ends(record) == ends(edge));
                let next = first + parts.count() as u32;
                *found = first..next;
                first = next;
            }
        }
        of_edges
    }

    /// An edge with its ends in the vertex order, and its opposite vertices in the order in which [`parts`] take them.
    fn taken(
        &mut self,
        mesh: &Mesh,
        topology: &Topology,
        edge: Edge,
        triangles: Option<&[EdgeTriangle]>,
    ) -> Edge {
        let own = topology.opposites_of(edge);
        let directed = in_vertex_order(&mesh.positions, edge);
        let first_opposite = self.opposites.len() as u32;
        match triangles {
            None if edge.opposite_count <= self.limit => return directed,
            None => self.opposites.extend(dealt_out(mesh, own, self.limit)),
            Some(triangles) => {
                let is_swapped = directed.a != edge.a;
                let side = |along: bool| {
                    let all = own.iter().zip(triangles);
                    let of_side = all.filter(|(_, t)| (t.is_along() != is_swapped) == along);
                    of_side.map(|(opposite, _)| *opposite).collect::<Vec<_>>()
                };
                let sides = [side(true), side(false)];
                let most = sides[0].len().max(sides[1].len());
                let parts = most.div_ceil(self.limit as usize / 2);
                let per_part = most.div_ceil(parts);
                let dealt = sides.map(|side| sorted(mesh, &side));
                for part in 0..parts {
                    for place in 0..per_part {
                        let at = part + place * parts;
                        let of_side = |side: &Vec<u32>| side.get(at).copied().unwrap_or(directed.a);
                        self.opposites.extend(dealt.iter().map(of_side));
                    }
                }
            }
        }
        Edge {
            first_opposite,
            opposite_count: self.opposites.len() as u32 - first_opposite,
            ..directed
        }
    }

    fn opposites_of(&self, edge: Edge) -> &[u32] {
        let first = edge.first_opposite as usize;
        &self.opposites[first..first + edge.opposite_count as usize]
    }

    /// Opposite vertices of the record that has most, at least 1.
    pub(super) fn most_opposites(&self) -> u32 {
        let counts = self.edges.iter().map(|edge| edge.opposite_count);
        counts.max().unwrap_or(0).max(1)
    }

    /// How many side quads more than without splitting are drawn under `light`: facings that would have
    /// cancelled within an edge do not cancel between its parts.
    pub(super) fn extra_side_quads(
        &self,
        mesh: &Mesh,
        determinism: Determinism,
        light: Vec4,
    ) -> u64 {
        let at = |vertex: u32| mesh.positions[vertex as usize];
        let quads = |edge: Edge| {
            let opposites = self.opposites_of(edge).iter();
            let facing = |o: &u32| determinism.facing(at(edge.a), at(edge.b), at(*o), light);
            u64::from(opposites.map(facing).sum::<i32>().unsigned_abs())
        };
        let extra = |edge: &Edge| parts(*edge, self.limit).map(quads).sum::<u64>() - quads(*edge);
        self.split.iter().map(extra).sum()
    }
}

/// Opposite vertices in the order in which [`parts`] take them: each part in turn gets one.
fn dealt_out(mesh: &Mesh, opposites: &[u32], limit: u32) -> impl Iterator<Item = u32> {
    let sorted = sorted(mesh, opposites);
    let parts = sorted.len().div_ceil(limit as usize);
    (0..parts).flat_map(move |part| {
        let own = sorted.iter().skip(part).step_by(parts);
        own.copied().collect::<Vec<_>>()
    })
}

/// Vertices in the vertex order.
fn sorted(mesh: &Mesh, vertices: &[u32]) -> Vec<u32> {
    let mut sorted = vertices.to_vec();
    sorted.sort_by(|one, other| {
        let [one, other] = [one, other].map(|vertex| mesh.positions[*vertex as usize].to_array());
        one.partial_cmp(&other).unwrap_or(Ordering::Equal)
    });
    sorted
}

/// The edge as several with at most `limit` opposite vertices each, as many as their turn gave them.
fn parts(edge: Edge, limit: u32) -> impl Iterator<Item = Edge> {
    let parts = edge.opposite_count.div_ceil(limit);
    let mut first_opposite = edge.first_opposite;
    (0..parts).map(move |part| {
        let opposite_count = (edge.opposite_count - part).div_ceil(parts);
        let own = Edge {
            first_opposite,
            opposite_count,
            ..edge
        };
        first_opposite += opposite_count;
        own
    })
}

fn in_vertex_order(positions: &[Vec3], edge: Edge) -> Edge {
    if vertex_less(positions[edge.b as usize], positions[edge.a as usize]) {
        Edge {
            a: edge.b,
            b: edge.a,
            ..edge
        }
    } else {
        edge
    }
}

/// Edges as input patches (Milet et al. 2014, figure 4): indices of the two end points, then of the
/// opposite vertices. A patch has the same number of vertices for every edge; the first end point fills
/// what is left, for a triangle with two equal vertices has no facing and so adds nothing.
pub(super) struct EdgePatches {
    pub(super) indices: Vec<u32>,
    pub(super) vertices_per_patch: u32,
    /// The indices of each object that casts, in drawing order.
    pub(super) objects: Vec<Range<u32>>,
}

impl EdgePatches {
    /// `opposites_per_patch` must be at least [`EdgeRecords::most_opposites`]. `None` if the indices
    /// would take more than `most_bytes`.
    pub(super) fn new(
        records: &EdgeRecords,
        opposites_per_patch: u32,
        most_bytes: u64,
    ) -> Option<Self> {
        let vertices_per_patch = 2 + opposites_per_patch;
        let count = records.edges.len() as u64 * u64::from(vertices_per_patch);
        if count > u64::from(u32::MAX) || 4 * count > most_bytes {
            return None;
        }
        let mut indices = Vec::with_capacity(records.edges.len() * vertices_per_patch as usize);
        for edge in &records.edges {
            let own = records.opposites_of(*edge);
            let end = indices.len() + vertices_per_patch as usize;
            indices.extend([edge.a, edge.b]);
            indices.extend_from_slice(own);
            indices.resize(end, edge.a);
        }
        let scaled =
            |range: &Range<u32>| range.start * vertices_per_patch..range.end * vertices_per_patch;
        Some(Self {
            indices,
            vertices_per_patch,
            objects: records.objects.iter().map(scaled).collect(),
        })
    }
}

#[cfg(test)]
#[path = "edge_records_tests.rs"]
mod tests;
