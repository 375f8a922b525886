//! Edges where surfaces end or turn over, whatever the light.
//!
//! Triangles that face the light and those that do not bound shadow volumes of their own. Let N₊ and N₋ be the numbers of
//! triangles of either kind between a point and the light: the point is in shadow where one of the two is not 0. Volumes
//! of the first kind have a silhouette wherever the surface folds over as the light sees it, and so have those of the
//! second; counted together, a fold counts twice. But S = N₊ − N₋ has no folds: the volumes of all triangles, each
//! wound as the triangle is, are bounded by the edges alone at which windings do not cancel, and these do not depend on
//! the light. So folds need only be counted once, in N₊, and N₋ = N₊ − S. (This and its use for open meshes we have not
//! found in the literature; of closed meshes S is 0, and N₊ alone will do.)

use super::silhouette::SilhouetteEdge;
use super::{EdgeTriangle, EdgeTriangles, Topology};
use crate::scene::Mesh;
use std::ops::Range;

/// The open edges of each object that casts.
pub struct OpenEdges {
    /// With their sums of windings in place of facings.
    edges: Vec<SilhouetteEdge>,
    casters: Vec<OfCaster>,
}

struct OfCaster {
    open: Range<usize>,
    edge_count: usize,
}

/// 1 for a triangle that goes from an edge's `a` to its `b`, -1 for one that goes back.
pub fn winding(triangle: EdgeTriangle) -> i32 {
    if triangle.is_along() { 1 } else { -1 }
}

/// Whether an edge with these triangles may be on the silhouette of those that face the light without being on that of
/// all: not so if it has one, or two in opposite directions.
pub fn is_irregular(triangles: &[EdgeTriangle]) -> bool {
    match triangles {
        [_] => false,
        [one, other] => one.is_along() == other.is_along(),
        _ => true,
    }
}

impl OpenEdges {
    /// Finds them.
    pub fn new(mesh: &Mesh, topology: &Topology, triangles: &EdgeTriangles) -> Self {
        let mut open = Vec::new();
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let casters = objects.filter(|(object, _)| object.casts_shadow);
        let casters = casters.map(|(_, numbers)| {
            let start = open.len();
            for number in numbers.clone() {
                let own = triangles.of(topology.edges[number as usize]);
                let multiplicity = own.iter().copied().map(winding).sum();
                if multiplicity != 0 {
                    open.push(SilhouetteEdge {
                        edge: number,
                        multiplicity,
                    });
                }
            }
            OfCaster {
                open: start..open.len(),
                edge_count: numbers.len(),
            }
        });
        let casters = casters.collect();
        Self {
            edges: open,
            casters,
        }
    }

    /// Those of a caster.
    pub fn of(&self, caster: usize) -> &[SilhouetteEdge] {
        &self.edges[self.casters[caster].open.clone()]
    }

    /// Which part of a caster's edges they are.
    pub fn share(&self, caster: usize) -> f64 {
        self.of(caster).len() as f64 / self.edge_count(caster).max(1) as f64
    }

    /// How many edges a caster has.
    pub fn edge_count(&self, caster: usize) -> usize {
        self.casters[caster].edge_count
    }
}
