//! Every triangle and every edge.

use super::{Facings, SilhouetteEdge, in_parallel};
use crate::geometry::Topology;
use crate::scene::mesh::Mesh;
use glam::Vec4;
use std::ops::Range;

/// Edges that one task asks at a time.
const EDGES_PER_TASK: usize = 4096;

/// Finds the facing of every triangle once, and then the multiplicity of every edge.
pub struct BruteForce {
    facings: Facings,
    /// For each opposite vertex of [`Topology::opposites`] where in `signed` the facing of its triangle along the edge is.
    places: Vec<u32>,
    /// For the light of the moment: of each triangle its facing, and the facing of its other winding.
    signed: Vec<[i8; 2]>,
    of_triangles: Vec<i8>,
    tasks: Vec<Range<usize>>,
}

impl BruteForce {
    /// Finds the triangles of all edges.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        let edges = topology.edges.len();
        let tasks = (0..edges).step_by(EDGES_PER_TASK);
        Self {
            facings: Facings::new(mesh),
            places: places(mesh, topology),
            signed: Vec::new(),
            of_triangles: vec![0; mesh.triangles.len()],
            tasks: tasks
                .map(|from| from..edges.min(from + EDGES_PER_TASK))
                .collect(),
        }
    }

    /// The silhouette, in ascending order of the edges. `light` is homogeneous, as in
    /// [`facing`](fn@crate::geometry::facing).
    pub fn silhouette(
        &mut self,
        mesh: &Mesh,
        topology: &Topology,
        light: Vec4,
    ) -> Vec<SilhouetteEdge> {
        self.facings.find(mesh, light, &mut self.of_triangles);
        self.signed.clear();
        let both = self.of_triangles.iter().map(|&facing| [facing, -facing]);
        self.signed.extend(both);
        let facings = self.signed.as_flattened();
        let facing = |place: u32| i32::from(facings[place as usize]);
        in_parallel(&self.tasks, 1, |task, found| {
            for (edge, number) in topology.edges[task.clone()].iter().zip(task.start as u32..) {
                let first = edge.first_opposite as usize;
                let places = &self.places[first..first + edge.opposite_count as usize];
                let multiplicity = match *places {
                    [one, other] => facing(one) + facing(other),
                    _ => places.iter().map(|&place| facing(place)).sum(),
                };
                if multiplicity != 0 {
                    found.push(SilhouetteEdge {
                        edge: number,
                        multiplicity,
                    });
                }
            }
        })
    }
}

/// Twice the number of the triangle, and one more if it is wound against the edge.
fn places(mesh: &Mesh, topology: &Topology) -> Vec<u32> {
    // Edges are in ascending order: those of a vertex are together.
    let mut first_edges = vec![0u32; mesh.positions.len() + 1];
    for edge in &topology.edges {
        first_edges[edge.a as usize + 1] += 1;
    }
    for vertex in 1..first_edges.len() {
        first_edges[vertex] += first_edges[vertex - 1];
    }
    let mut places = vec![0; topology.opposites.len()];
    for object in mesh.casters() {
        for (number, &[a, b, c]) in object
            .triangle_range()
            .zip(&mesh.triangles[object.triangle_range()])
        {
            for (from, to, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
                let (low, high) = (from.min(to) as usize, from.max(to));
                let of_low = first_edges[low] as usize..first_edges[low + 1] as usize;
                let edge = topology.edges[of_low].iter().find(|edge| edge.b == high);
                let Some(edge) = edge else { continue };
                let own = topology.opposites_of(*edge);
                let is_against = u32::from(from > to);
                // Of triangles with the same vertices, any one will do for all.
                for place in (0..own.len()).filter(|place| own[*place] == opposite) {
                    places[edge.first_opposite as usize + place] = 2 * number as u32 + is_against;
                }
            }
        }
    }
    places
}
