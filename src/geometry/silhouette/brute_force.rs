//! Every triangle and every edge.

use super::{Facings, SilhouetteEdge, in_parallel};
use crate::geometry::{EdgeTriangle, EdgeTriangles, Topology};
use crate::scene::mesh::Mesh;
use glam::Vec4;
use std::ops::Range;

/// Edges that one task asks at a time.
const EDGES_PER_TASK: usize = 4096;

/// Finds the facing of every triangle once, and then the multiplicity of every edge.
pub struct BruteForce {
    facings: Facings,
    triangles: EdgeTriangles,
    /// For the light of the moment.
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
            triangles: EdgeTriangles::build(mesh, topology),
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
        let facing = |triangle: EdgeTriangle| {
            let own = i32::from(self.of_triangles[triangle.triangle()]);
            if triangle.is_along() { own } else { -own }
        };
        in_parallel(&self.tasks, 1, |task, found| {
            for (edge, number) in topology.edges[task.clone()].iter().zip(task.start as u32..) {
                let multiplicity = match *self.triangles.of(*edge) {
                    [one, other] => facing(one) + facing(other),
                    ref all => all.iter().map(|&triangle| facing(triangle)).sum(),
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
