use std::collections::BTreeMap;

use glam::Vec3;
use proptest::prelude::*;

use super::*;
use crate::scene::mesh::Object;

/// A mesh of objects, each given by its vertex count and its triangles in indices of its own.
fn mesh_of(objects: &[(u32, Vec<[u32; 3]>, bool)]) -> Mesh {
    let mut mesh = Mesh::default();
    for (vertex_count, triangles, casts_shadow) in objects {
        let first_vertex = mesh.positions.len() as u32;
        let first_triangle = mesh.triangles.len() as u32;
        mesh.positions
            .extend((0..*vertex_count).map(|i| Vec3::splat(i as f32)));
        mesh.triangles
            .extend(triangles.iter().map(|t| t.map(|v| v + first_vertex)));
        mesh.objects.push(Object {
            name: String::new(),
            vertices: first_vertex..mesh.positions.len() as u32,
            triangles: first_triangle..mesh.triangles.len() as u32,
            casts_shadow: *casts_shadow,
        });
    }
    mesh
}

fn single(vertex_count: u32, triangles: Vec<[u32; 3]>) -> Topology {
    Topology::build(&mesh_of(&[(vertex_count, triangles, true)]))
}

fn counts(boundary: usize, manifold: usize, non_manifold: usize) -> EdgeCounts {
    EdgeCounts {
        boundary,
        manifold,
        non_manifold,
    }
}

/// Edge → opposite vertices, both sorted: what a topology says, and what it should say.
type Edges = BTreeMap<(u32, u32), Vec<u32>>;

fn found(topology: &Topology) -> Edges {
    topology
        .edges
        .iter()
        .map(|&e| ((e.a, e.b), topology.opposites_of(e).to_vec()))
        .collect()
}

fn brute_force(mesh: &Mesh) -> Edges {
    let mut edges = Edges::new();
    for object in mesh.casters() {
        for &[a, b, c] in &mesh.triangles[object.triangle_range()] {
            if a != b && b != c && c != a {
                for (u, v, w) in [(a, b, c), (b, c, a), (c, a, b)] {
                    edges.entry((u.min(v), u.max(v))).or_default().push(w);
                }
            }
        }
    }
    edges
        .values_mut()
        .for_each(|opposites| opposites.sort_unstable());
    edges
}

#[test]
fn a_tetrahedron_is_closed() {
    let topology = single(4, vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]);
    assert_eq!(topology.counts(), counts(0, 6, 0));
    assert!(topology.counts().is_closed_manifold());
    assert_eq!(
        topology.edges[0],
        Edge {
            a: 0,
            b: 1,
            first_opposite: 0,
            opposite_count: 2
        }
    );
    assert_eq!(topology.opposites_of(topology.edges[0]), [2, 3]);
}

#[test]
fn an_open_grid_has_its_rim_as_boundary() {
    let (width, height) = (7, 4);
    let at = |x: u32, y: u32| y * (width + 1) + x;
    let cells = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let triangles = cells
        .flat_map(|(x, y)| {
            let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let topology = single((width + 1) * (height + 1), triangles);
    let rim = 2 * (width + height) as usize;
    let inner = (3 * 2 * (width * height) as usize - rim) / 2;
    assert_eq!(topology.counts(), counts(rim, inner, 0));
}

#[test]
fn a_fan_of_pages_has_all_of_them_on_its_spine() {
    for pages in 1..=300 {
        let topology = single(pages + 2, (0..pages).map(|page| [0, 1, page + 2]).collect());
        assert_eq!(topology.edges.len() as u32, 1 + 2 * pages);
        assert_eq!(topology.edges[0].opposite_count, pages);
        let spine = topology.opposites_of(topology.edges[0]);
        assert!(spine.iter().copied().eq(2..pages + 2));
    }
}

#[test]
fn a_duplicate_triangle_counts_twice_and_a_degenerate_one_not_at_all() {
    let topology = single(
        3,
        vec![[0, 1, 2], [2, 1, 0], [0, 0, 1], [1, 2, 2], [2, 2, 2]],
    );
    assert_eq!(topology.counts(), counts(0, 3, 0));
    assert_eq!(topology.opposites, [2, 2, 1, 1, 0, 0]);
}

#[test]
fn objects_have_edges_of_their_own_and_receivers_none() {
    let triangle = vec![[0, 1, 2]];
    let mesh = mesh_of(&[
        (3, triangle.clone(), true),
        (3, triangle.clone(), false),
        (5, vec![], true),
        (3, triangle, true),
    ]);
    let topology = Topology::build(&mesh);
    assert_eq!(topology.object_edges, [0..3, 3..3, 3..3, 3..6]);
    assert_eq!(topology.edges[3].a, 11);
}

#[test]
fn no_mesh_has_no_edges() {
    assert_eq!(Topology::build(&Mesh::default()), Topology::default());
}

proptest! {
    #[test]
    fn any_soup_gives_what_brute_force_gives(
        soups in prop::collection::vec(
            (prop::collection::vec([0u32..12, 0u32..12, 0u32..12], 0..60), prop::bool::ANY), 0..6),
        stripe_count in 1usize..40,
    ) {
        let objects: Vec<_> = soups.into_iter().map(|(t, casts)| (12, t, casts)).collect();
        let mesh = mesh_of(&objects);
        let topology = Topology::build_in_stripes(&mesh, stripe_count);
        prop_assert_eq!(found(&topology), brute_force(&mesh));
        prop_assert_eq!(&topology, &Topology::build(&mesh));
        prop_assert!(topology.edges.is_sorted_by_key(|e| (e.a, e.b)));
        for (object, edges) in mesh.objects.iter().zip(&topology.object_edges) {
            let edges = &topology.edges[edges.start as usize..edges.end as usize];
            prop_assert!(object.casts_shadow || edges.is_empty());
            prop_assert!(edges.iter().all(|e| object.vertices.contains(&e.a)));
        }
    }
}
