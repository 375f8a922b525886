//! Side quads as lists of corners.

use crate::geometry::silhouette::SilhouetteEdge;
use crate::geometry::{Topology, vertex_less};
use crate::scene::Mesh;

/// An edge with side quads, with its ends in the vertex order: copies of an edge in different objects are then drawn
/// alike.
#[derive(Debug, Clone, Copy)]
pub(super) struct DirectedEdge {
    pub(super) a: u32,
    pub(super) b: u32,
    /// See [`SilhouetteEdge`]; positive where the light sees the surface on the left of `a` to `b`.
    pub(super) multiplicity: i32,
}

impl DirectedEdge {
    pub(super) fn new(mesh: &Mesh, topology: &Topology, found: SilhouetteEdge) -> Self {
        let at = |vertex: u32| mesh.positions[vertex as usize];
        let edge = topology.edges[found.edge as usize];
        let (a, b, multiplicity) = if vertex_less(at(edge.b), at(edge.a)) {
            (edge.b, edge.a, -found.multiplicity)
        } else {
            (edge.a, edge.b, found.multiplicity)
        };
        Self { a, b, multiplicity }
    }

    /// The two triangles of one of its quads, counter-clockwise seen from outside of the volume.
    ///
    /// The corners lie in one plane only but for rounding, so the diagonal matters to the last bit of depth: both windings
    /// are cut from `b` to the far end of `a`, so that opposite copies cancel to the pixel. The first three are the
    /// whole where far ends meet.
    pub(super) fn quad(&self, near: impl Fn(u32) -> u32, far: impl Fn(u32) -> u32) -> [u32; 6] {
        let &Self { a, b, multiplicity } = self;
        if multiplicity > 0 {
            [near(a), far(a), near(b), near(b), far(a), far(b)]
        } else {
            [near(a), near(b), far(a), near(b), far(b), far(a)]
        }
    }
}
