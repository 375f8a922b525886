//! What is known of silhouette edges before there is a light.

use crate::geometry::open_edges::is_irregular;
use crate::geometry::silhouette::SilhouetteEdge;
use crate::geometry::{EdgeTriangles, Topology, facing};
use crate::methods::side_quad::DirectedEdge;
use crate::scene::Mesh;
use glam::Vec4;
use std::rc::Rc;

/// In the first end of an edge: its ends are not in the order of [`Topology`].
const SWAPPED: u32 = 1 << 31;

/// In the second end: see [`CasterEdges::irregular`].
const IRREGULAR: u32 = 1 << 31;

/// The edges of a scene as its volumes need them.
pub(super) struct CasterEdges {
    /// The ends of each edge in the vertex order: copies of an edge in different objects are then drawn alike.
    ends: Vec<[u32; 2]>,
    /// The caster that each edge belongs to, in drawing order.
    casters: Vec<u32>,
    triangles: Rc<EdgeTriangles>,
    /// Of each caster, see [`is_irregular`].
    irregular: Vec<Vec<u32>>,
}

impl CasterEdges {
    pub(super) fn new(mesh: &Mesh, topology: &Topology, triangles: Rc<EdgeTriangles>) -> Self {
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let of_casters = objects
            .filter(|(object, _)| object.casts_shadow)
            .map(|(_, edges)| edges);
        let casters = (0..)
            .zip(of_casters.clone())
            .flat_map(|(caster, edges)| edges.clone().map(move |_| caster));
        let is_irregular = |edge: &u32| is_irregular(triangles.of(topology.edges[*edge as usize]));
        let irregular = of_casters.map(|edges| edges.clone().filter(is_irregular).collect());
        let ends = (0..topology.edges.len() as u32).map(|edge| {
            let multiplicity = 1;
            let found = SilhouetteEdge { edge, multiplicity };
            let directed = DirectedEdge::new(mesh, topology, found);
            let swapped = if directed.multiplicity < 0 {
                SWAPPED
            } else {
                0
            };
            let irregular = if is_irregular(&edge) { IRREGULAR } else { 0 };
            [directed.a | swapped, directed.b | irregular]
        });
        Self {
            ends: ends.collect(),
            casters: casters.collect(),
            irregular: irregular.collect(),
            triangles,
        }
    }

    pub(super) fn caster(&self, edge: u32) -> usize {
        self.casters[edge as usize] as usize
    }

    /// Whether it is one of [`Self::irregular`].
    pub(super) fn is_irregular(&self, edge: u32) -> bool {
        self.ends[edge as usize][1] & IRREGULAR != 0
    }

    pub(super) fn directed(&self, edge: u32, multiplicity: i32) -> DirectedEdge {
        let [a, b] = self.ends[edge as usize];
        DirectedEdge {
            a: a & !SWAPPED,
            b: b & !IRREGULAR,
            multiplicity: if a & SWAPPED != 0 {
                -multiplicity
            } else {
                multiplicity
            },
        }
    }

    /// The edges of a caster whose multiplicity does not say what that of light-facing triangles is.
    pub(super) fn irregular(&self, caster: usize) -> &[u32] {
        &self.irregular[caster]
    }

    /// The multiplicity of an edge if only triangles that face the light cast.
    pub(super) fn light_facing_multiplicity(
        &self,
        mesh: &Mesh,
        topology: &Topology,
        light: Vec4,
        number: u32,
    ) -> i32 {
        let edge = topology.edges[number as usize];
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
