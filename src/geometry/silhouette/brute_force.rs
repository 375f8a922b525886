//! Every triangle and every edge.

use super::{EDGES_PER_TASK, Facings, SilhouetteEdge, in_parallel};
use crate::geometry::{EdgeTriangle, EdgeTriangles, Topology};
use crate::scene::mesh::Mesh;
use glam::Vec4;

/// Finds the facing of every triangle once, and then the multiplicity of every edge.
pub struct BruteForce {
    facings: Facings,
    triangles: EdgeTriangles,
    /// For the light of the moment.
    of_triangles: Vec<i8>,
}

impl BruteForce {
    /// Finds the triangles of all edges.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        Self {
            facings: Facings::new(mesh),
            triangles: EdgeTriangles::build(mesh, topology),
            of_triangles: vec![0; mesh.triangles.len()],
        }
    }

    /// Finds the silhouette, in ascending order of the edges. `light` is homogeneous, as in
    /// [`facing`](fn@crate::geometry::facing). What `found` has is replaced.
    pub fn silhouette(
        &mut self,
        mesh: &Mesh,
        topology: &Topology,
        light: Vec4,
        found: &mut Vec<SilhouetteEdge>,
    ) {
        self.facings.find(mesh, light, &mut self.of_triangles);
        let facing = |triangle: EdgeTriangle| {
            let own = i32::from(self.of_triangles[triangle.triangle()]);
            if triangle.is_along() { own } else { -own }
        };
        found.clear();
        in_parallel(
            &topology.edges,
            EDGES_PER_TASK,
            found,
            |first, edges, found| {
                for (edge, number) in edges.iter().zip(first as u32..) {
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
            },
        );
    }
}
