//! What is known of silhouette edges before there is a light.

use crate::geometry::silhouette::SilhouetteEdge;
use crate::geometry::{EdgeTriangles, Topology, facing, vertex_less};
use crate::scene::Mesh;
use glam::Vec4;

/// In the first end of an edge: its ends are not in the order of [`Topology`].
const SWAPPED: u32 = 1 << 31;

/// The edges of a scene as its volumes need them.
pub(super) struct CasterEdges {
    /// The ends of each edge in the vertex order: copies of an edge in different objects are then drawn alike.
    ends: Vec<[u32; 2]>,
    /// The caster that each edge belongs to, in drawing order.
    casters: Vec<u32>,
    triangles: EdgeTriangles,
}

/// An edge on the silhouette, with its ends in the vertex order.
pub(super) struct DirectedEdge {
    pub(super) a: u32,
    pub(super) b: u32,
    /// See [`SilhouetteEdge`]; positive where the light sees the surface on the left of `a` to `b`.
    pub(super) multiplicity: i32,
}

impl CasterEdges {
    pub(super) fn new(mesh: &Mesh, topology: &Topology) -> Self {
        let at = |vertex: u32| mesh.positions[vertex as usize];
        let ends = topology.edges.iter().map(|edge| {
            if vertex_less(at(edge.b), at(edge.a)) {
                [edge.b | SWAPPED, edge.a]
            } else {
                [edge.a, edge.b]
            }
        });
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let of_casters = objects
            .filter(|(object, _)| object.casts_shadow)
            .map(|(_, edges)| edges);
        let casters = (0..)
            .zip(of_casters)
            .flat_map(|(caster, edges)| edges.clone().map(move |_| caster));
        Self {
            ends: ends.collect(),
            casters: casters.collect(),
            triangles: EdgeTriangles::build(mesh, topology),
        }
    }

    /// For each caster whether it is closed and wound consistently.
    pub(super) fn closed_casters(&self, mesh: &Mesh, topology: &Topology) -> Vec<bool> {
        self.triangles.closed_casters(mesh, topology)
    }

    pub(super) fn caster(&self, edge: u32) -> usize {
        self.casters[edge as usize] as usize
    }

    pub(super) fn directed(&self, edge: u32, multiplicity: i32) -> DirectedEdge {
        let [a, b] = self.ends[edge as usize];
        let is_swapped = a & SWAPPED != 0;
        DirectedEdge {
            a: a & !SWAPPED,
            b,
            multiplicity: if is_swapped {
                -multiplicity
            } else {
                multiplicity
            },
        }
    }

    /// The multiplicity of an edge of a closed caster if only triangles that face the light cast.
    pub(super) fn light_facing_multiplicity(
        &self,
        mesh: &Mesh,
        topology: &Topology,
        light: Vec4,
        found: SilhouetteEdge,
    ) -> i32 {
        // Of two triangles in opposite directions, one faces the light where both have a facing.
        if found.multiplicity % 2 == 0 {
            return found.multiplicity / 2;
        }
        let edge = topology.edges[found.edge as usize];
        let at = |vertex: u32| mesh.positions[vertex as usize];
        let sides = topology
            .opposites_of(edge)
            .iter()
            .zip(self.triangles.of(edge));
        let cast = sides.map(|(opposite, triangle)| {
            let along = if triangle.is_along() { 1 } else { -1 };
            let facing = facing(at(edge.a), at(edge.b), at(*opposite), light);
            if facing == along { along } else { 0 }
        });
        cast.sum()
    }
}

/// For each vertex one of the same connected part of its object: where fans of that part meet.
pub(super) fn fan_apexes(mesh: &Mesh, topology: &Topology) -> Vec<u32> {
    let mut parents: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for edge in &topology.edges {
        let (a, b) = (root(&mut parents, edge.a), root(&mut parents, edge.b));
        // The smallest vertex is the root.
        parents[a.max(b) as usize] = a.min(b);
    }
    (0..parents.len() as u32)
        .map(|vertex| root(&mut parents, vertex))
        .collect()
}

fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        // Paths are halved on the way.
        parents[vertex as usize] = parents[parents[vertex as usize] as usize];
        vertex = parents[vertex as usize];
    }
    vertex
}
