//! The triangles of edges, and which way each is wound.

use super::{Edge, Topology};
use crate::scene::mesh::Mesh;
use rayon::prelude::*;
use std::ops::Range;

/// A triangle on an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeTriangle(u32);

impl EdgeTriangle {
    /// Not found yet; no mesh has so many triangles.
    const UNKNOWN: Self = Self(u32::MAX);

    fn new(triangle: usize, along: bool) -> Self {
        Self(2 * triangle as u32 + u32::from(!along))
    }

    /// Its number in [`Mesh::triangles`].
    pub fn triangle(self) -> usize {
        (self.0 / 2) as usize
    }

    /// Whether it goes from the edge's `a` to its `b`, so that its facing is that of `a`, `b`, opposite vertex.
    pub fn is_along(self) -> bool {
        self.0.is_multiple_of(2)
    }
}

/// The triangles of all edges of a [`Topology`].
pub struct EdgeTriangles {
    /// One for each of [`Topology::opposites`].
    triangles: Vec<EdgeTriangle>,
}

/// The edges of some vertices, and where their triangles go.
struct Stripe<'a> {
    vertices: Range<u32>,
    edges: &'a [Edge],
    triangles: &'a mut [EdgeTriangle],
}

impl EdgeTriangles {
    /// Finds them, on all cores. Triangles with the same three vertices come in the order of the mesh.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        let mut triangles = vec![EdgeTriangle::UNKNOWN; topology.opposites.len()];
        let stripes = stripes(mesh, topology, &mut triangles);
        stripes
            .into_par_iter()
            .for_each(|stripe| stripe.fill(mesh, topology));
        Self { triangles }
    }

    /// The triangles of an edge, in the order of its opposite vertices.
    pub fn of(&self, edge: Edge) -> &[EdgeTriangle] {
        let first = edge.first_opposite as usize;
        &self.triangles[first..first + edge.opposite_count as usize]
    }

    /// For each object that casts, in drawing order, whether it is closed and wound consistently: each of its edges has
    /// two triangles, one in either direction.
    pub fn closed_casters(&self, mesh: &Mesh, topology: &Topology) -> Vec<bool> {
        let is_closed = |edge: &Edge| match self.of(*edge) {
            [one, other] => one.is_along() != other.is_along(),
            _ => false,
        };
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let casters = objects.filter(|(object, _)| object.casts_shadow);
        casters
            .map(|(_, edges)| {
                topology.edges[edges.start as usize..edges.end as usize]
                    .iter()
                    .all(is_closed)
            })
            .collect()
    }
}

/// Cuts the range of vertices into a stripe for each core.
fn stripes<'a>(
    mesh: &Mesh,
    topology: &'a Topology,
    mut triangles: &'a mut [EdgeTriangle],
) -> Vec<Stripe<'a>> {
    let vertices = mesh.positions.len();
    let stripe_len = vertices.div_ceil(rayon::current_num_threads()).max(1);
    let mut edges = &topology.edges[..];
    let mut stripes = Vec::new();
    for start in (0..vertices).step_by(stripe_len) {
        let end = (start + stripe_len).min(vertices) as u32;
        let (own, rest) = edges.split_at(edges.partition_point(|edge| edge.a < end));
        let count = own.iter().map(|edge| edge.opposite_count as usize).sum();
        let (own_triangles, rest_triangles) = triangles.split_at_mut(count);
        stripes.push(Stripe {
            vertices: start as u32..end,
            edges: own,
            triangles: own_triangles,
        });
        (edges, triangles) = (rest, rest_triangles);
    }
    stripes
}

impl Stripe<'_> {
    fn fill(self, mesh: &Mesh, topology: &Topology) {
        let Some(base) = self.edges.first().map(|edge| edge.first_opposite) else {
            return;
        };
        // Edges are in ascending order, so those of a vertex are together.
        let mut firsts = vec![0u32; self.vertices.len() + 1];
        for edge in self.edges {
            firsts[(edge.a - self.vertices.start) as usize + 1] += 1;
        }
        for vertex in 1..firsts.len() {
            firsts[vertex] += firsts[vertex - 1];
        }
        let meets =
            |other: &Range<u32>| other.start < self.vertices.end && self.vertices.start < other.end;
        for object in mesh.casters().filter(|object| meets(&object.vertices)) {
            for number in object.triangle_range() {
                let [a, b, c] = mesh.triangles[number];
                for (from, to, opposite) in [(a, b, c), (b, c, a), (c, a, b)] {
                    // Below the stripe this wraps to a large number.
                    let low = from.min(to).wrapping_sub(self.vertices.start) as usize;
                    if low >= self.vertices.len() {
                        continue;
                    }
                    let of_low = &self.edges[firsts[low] as usize..firsts[low + 1] as usize];
                    let Some(edge) = of_low.iter().find(|edge| edge.b == from.max(to)) else {
                        continue;
                    };
                    let first = (edge.first_opposite - base) as usize;
                    let opposites = topology.opposites_of(*edge).iter();
                    let mut places = opposites.zip(&mut self.triangles[first..]);
                    let is_its_place = |(known, found): &(&u32, &mut EdgeTriangle)| {
                        **known == opposite && **found == EdgeTriangle::UNKNOWN
                    };
                    if let Some((_, place)) = places.find(is_its_place) {
                        *place = EdgeTriangle::new(number, from < to);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Part;
    use crate::scene::sphere_grid::SphereGrid;
    use glam::Vec3;

    fn mesh(triangles: &[[Vec3; 3]]) -> Mesh {
        [Part::of_triangles("part", triangles)]
            .into_iter()
            .collect()
    }

    #[test]
    fn a_triangle_of_an_edge_has_its_ends_and_its_opposite_vertex() {
        let grid = SphereGrid {
            rows: 2,
            columns: 2,
            slices: 6,
            shells: 1,
        };
        let mesh = grid.mesh().unwrap();
        let topology = Topology::build(&mesh);
        let all = EdgeTriangles::build(&mesh, &topology);
        for &edge in &topology.edges {
            for (&opposite, found) in topology.opposites_of(edge).iter().zip(all.of(edge)) {
                let triangle = mesh.triangles[found.triangle()];
                let (from, to) = if found.is_along() {
                    (edge.a, edge.b)
                } else {
                    (edge.b, edge.a)
                };
                let turns =
                    [0, 1, 2].map(|i| [triangle[i], triangle[(i + 1) % 3], triangle[(i + 2) % 3]]);
                assert!(
                    turns.contains(&[from, to, opposite]),
                    "{edge:?} {triangle:?}"
                );
            }
        }
    }

    #[test]
    fn only_what_is_closed_and_wound_one_way_is_closed() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
            .map(|face| face.map(|i: usize| corners[i]));
        let is_closed = |triangles: &[[Vec3; 3]]| {
            let mesh = mesh(triangles);
            let topology = Topology::build(&mesh);
            EdgeTriangles::build(&mesh, &topology).closed_casters(&mesh, &topology)
        };
        assert_eq!(is_closed(&faces), [true]);
        assert_eq!(is_closed(&faces[1..]), [false], "a hole");
        let [a, b, c] = faces[0];
        let turned = [&faces[1..], &[[a, c, b]]].concat();
        assert_eq!(is_closed(&turned), [false], "one face turned around");
        let doubled = [&faces[..], &faces[..1]].concat();
        assert_eq!(is_closed(&doubled), [false], "one face twice");
        let leaf = [[a, b, c], [a, b, c]];
        assert_eq!(is_closed(&leaf), [false], "a triangle and its copy");
        let two_sided = [[a, b, c], [a, c, b]];
        assert_eq!(is_closed(&two_sided), [true], "a leaf of two sides");
    }
}
