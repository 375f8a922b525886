//! Edges as WGSL shaders take them.

use super::side_quad::DirectedEdge;
use super::{Casters, MethodError};
use crate::geometry::silhouette::SilhouetteEdge;
use crate::geometry::{EdgeTriangle, Topology};

/// Bits of an edge's last word that are the number of its triangles: multiplicities are kept in 16 bits. Those above say whose
/// edge it is.
const TRIANGLE_BITS: u32 = 15;
const MOST_TRIANGLES: u32 = (1 << TRIANGLE_BITS) - 1;
const MOST_CASTERS: usize = 1 << (32 - TRIANGLE_BITS);

/// What the triangles of edges are given by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SidesBy {
    OppositeVertex,
    Triangle,
}

/// Whether edges and casters have numbers.
///
/// # Errors
/// When there are more.
pub(super) fn check(topology: &Topology, casters: usize) -> Result<(), MethodError> {
    let triangles = topology.edges.iter().map(|edge| edge.opposite_count);
    let most = triangles.max().unwrap_or(0);
    if most > MOST_TRIANGLES {
        let message = format!(
            "an edge with {most} triangles has more than the {MOST_TRIANGLES} that it can count"
        );
        return Err(MethodError::Unavailable(message));
    }
    if casters > MOST_CASTERS {
        let message =
            format!("{casters} objects are more than the {MOST_CASTERS} that it can number");
        return Err(MethodError::Unavailable(message));
    }
    Ok(())
}

/// The edges with their ends in the vertex order, and their triangles: see multiplicity.wgsl.
pub(super) type EdgesAndSides = (Vec<[u32; 4]>, Vec<u32>);

/// Those of all casters.
pub(super) fn edges_and_sides(casters: &Casters, by: SidesBy) -> EdgesAndSides {
    let (mesh, topology) = (&casters.mesh, casters.topology());
    let triangles = casters.edge_triangles();
    let mut sides = Vec::with_capacity(topology.opposites.len());
    let objects = mesh.objects.iter().zip(&topology.object_edges);
    let of_casters = objects.filter(|(object, _)| object.casts_shadow);
    let of_casters = (0..).zip(of_casters);
    let numbers =
        of_casters.flat_map(|(caster, (_, edges))| edges.clone().map(move |edge| (caster, edge)));
    let edges = numbers.map(|(caster, number): (u32, u32)| {
        let edge = &topology.edges[number as usize];
        let found = SilhouetteEdge {
            edge: number,
            multiplicity: 1,
        };
        let directed = DirectedEdge::new(mesh, topology, found);
        let is_swapped = directed.multiplicity < 0;
        let first = sides.len() as u32;
        let side = |(opposite, own): (&u32, &EdgeTriangle)| {
            let other = match by {
                SidesBy::OppositeVertex => *opposite,
                SidesBy::Triangle => own.triangle() as u32,
            };
            2 * other + u32::from(own.is_along() == is_swapped)
        };
        let opposites = topology.opposites_of(*edge).iter();
        sides.extend(opposites.zip(triangles.of(*edge)).map(side));
        let word = edge.opposite_count | caster << TRIANGLE_BITS;
        [directed.a, directed.b, first, word]
    });
    (edges.collect(), sides)
}

/// The same in another order; a number that no edge has leaves a place with an edge without triangles.
pub(super) fn in_order((edges, sides): &EdgesAndSides, order: &[u32]) -> EdgesAndSides {
    let mut ordered = Vec::with_capacity(sides.len());
    let record = |&number: &u32| {
        let Some(&[a, b, first, word]) = edges.get(number as usize) else {
            return [0; 4];
        };
        let count = word & ((1 << TRIANGLE_BITS) - 1);
        let own = &sides[first as usize..(first + count) as usize];
        let first = ordered.len() as u32;
        ordered.extend_from_slice(own);
        [a, b, first, word]
    };
    (order.iter().map(record).collect(), ordered)
}
