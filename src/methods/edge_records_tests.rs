use super::*;
use crate::scene::Object;

/// Three edges in two objects that cast, with one between them that does not.
fn example() -> (Mesh, Topology) {
    let edge = |first_opposite, opposite_count| Edge {
        a: 0,
        b: 1,
        first_opposite,
        opposite_count,
    };
    let object = |casts_shadow| Object {
        name: String::new(),
        vertices: 0..10,
        triangles: 0..0,
        casts_shadow,
    };
    let mesh = Mesh {
        positions: (0..10).map(|i| Vec3::X * i as f32).collect(),
        objects: vec![object(true), object(false), object(true)],
        ..Mesh::default()
    };
    let topology = Topology {
        edges: vec![edge(0, 2), edge(2, 7), edge(9, 1)],
        opposites: (0..10).collect(),
        object_edges: vec![0..2, 2..2, 2..3],
    };
    (mesh, topology)
}

#[test]
fn splitting_keeps_every_opposite_vertex_once() {
    let (mesh, topology) = example();
    let records = EdgeRecords::new(&mesh, &topology, None, 3);
    let parts: Vec<_> = records
        .edges
        .iter()
        .map(|e| records.opposites_of(*e))
        .collect();
    let expected: [&[u32]; 5] = [&[0, 1], &[2, 5, 8], &[3, 6], &[4, 7], &[9]];
    assert_eq!(parts, expected);
    assert_eq!(records.objects, [0..4, 4..5]);
    assert_eq!(records.most_opposites(), 3);
}

#[test]
fn patches_are_filled_with_their_first_vertex() {
    let (mesh, topology) = example();
    let records = EdgeRecords::new(&mesh, &topology, None, 3);
    let patches = |most_bytes| EdgePatches::new(&records, 4, most_bytes);
    assert!(patches(4 * 30 - 1).is_none());
    let patches = patches(4 * 30).unwrap();
    assert_eq!(patches.vertices_per_patch, 6);
    assert_eq!(patches.indices[..12], [0, 1, 0, 1, 0, 0, 0, 1, 2, 5, 8, 0]);
    assert_eq!(patches.objects, [0..24, 24..30]);
}

#[test]
fn end_points_come_in_the_vertex_order() {
    let edge = Edge {
        a: 0,
        b: 1,
        first_opposite: 0,
        opposite_count: 1,
    };
    let ends = |positions: [Vec3; 2]| {
        let edge = in_vertex_order(&positions, edge);
        (edge.a, edge.b)
    };
    assert_eq!(ends([Vec3::ZERO, Vec3::X]), (0, 1));
    assert_eq!(ends([Vec3::X, Vec3::ZERO]), (1, 0));
}

#[test]
fn what_splitting_costs_is_counted() {
    // Pages above and below an edge along x, half of them facing each way under a lamp.
    let pages = [1.0, -1.0, 1.0, -1.0].map(|z| Vec3::new(0.5, 0.0, z));
    let mesh = Mesh {
        positions: [Vec3::ZERO, Vec3::X].into_iter().chain(pages).collect(),
        triangles: (2..6).map(|page| [0, 1, page]).collect(),
        objects: vec![Object {
            name: String::new(),
            vertices: 0..6,
            triangles: 0..4,
            casts_shadow: true,
        }],
    };
    let topology = Topology::build(&mesh);
    let light = Vec4::new(0.5, 9.0, 0.0, 1.0);
    let extra = |limit| {
        EdgeRecords::new(&mesh, &topology, None, limit).extra_side_quads(
            &mesh,
            Determinism::ReferenceEdge,
            light,
        )
    };
    assert_eq!(extra(4), 0);
    assert_eq!(extra(2), 0, "each part holds one page of either side");
    assert_eq!(extra(1), 4);
}
