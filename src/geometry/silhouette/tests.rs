use super::*;
use crate::scene::Part;
use crate::scene::mesh::canonical;
use crate::scene::sphere_grid::SphereGrid;
use glam::Vec3;
use proptest::prelude::*;

/// Corners on a coarse lattice or anywhere: lattices have triangles in one plane, without area, and on top of each other.
fn corner() -> impl Strategy<Value = Vec3> {
    let lattice = (-2i8..=2, -2i8..=2, -2i8..=2)
        .prop_map(|(x, y, z)| Vec3::new(f32::from(x), f32::from(y), f32::from(z)));
    let anywhere = [-3.0f32..3.0, -3.0..3.0, -3.0..3.0].prop_map(Vec3::from_array);
    let far = (anywhere.clone(), -12i32..20).prop_map(|(p, power)| canonical(p * 2f32.powi(power)));
    prop_oneof![3 => lattice, 3 => anywhere.prop_map(canonical), 1 => far]
}

fn soup() -> impl Strategy<Value = Mesh> {
    let pool = prop::collection::vec(corner(), 3..14);
    pool.prop_flat_map(|pool| {
        let corner = prop::sample::select(pool);
        let triangle = [corner.clone(), corner.clone(), corner];
        prop::collection::vec(triangle, 1..120)
    })
    .prop_map(|triangles| {
        [Part::of_triangles("soup", &triangles)]
            .into_iter()
            .collect()
    })
}

/// A sphere that is moved, stretched and damaged: triangles dropped, doubled and turned around.
fn damaged() -> impl Strategy<Value = Mesh> {
    let fates = prop::collection::vec(0u8..20, 4 * 6 * 6);
    (3u32..6, fates, corner(), corner()).prop_map(|(slices, fates, shift, stretch)| {
        let grid = SphereGrid {
            rows: 1,
            columns: 1,
            slices: 2 * slices,
            shells: 1,
        };
        let mesh = grid.mesh().unwrap();
        let mut triangles = Vec::new();
        for (index, fate) in (0..mesh.triangles.len()).zip(fates.iter().cycle()) {
            let [a, b, c] = mesh
                .corners(index)
                .map(|p| canonical(p * (stretch.abs() + 0.1) + shift));
            match fate {
                0 => {}
                1 => triangles.extend([[a, b, c], [a, b, c]]),
                2 => triangles.push([a, c, b]),
                _ => triangles.push([a, b, c]),
            }
        }
        [Part::of_triangles("damaged", &triangles)]
            .into_iter()
            .collect()
    })
}

/// A few triangles in one plane but for rounding: a light in it faces them by rounding alone, and their planes are
/// together on one side of it.
fn flat() -> impl Strategy<Value = Mesh> {
    let place = [-2.0f32..2.0, -2.0..2.0];
    let axes = [corner(), corner(), corner()];
    (axes, prop::collection::vec(place, 4..7)).prop_map(|([origin, u, v], places)| {
        let corners = places
            .iter()
            .map(|[s, t]| canonical(origin + *s * u + *t * v));
        let corners: Vec<Vec3> = corners.collect();
        let fan = corners
            .windows(2)
            .skip(1)
            .map(|ends| [corners[0], ends[0], ends[1]]);
        let fan: Vec<_> = fan.collect();
        [Part::of_triangles("flat", &fan)].into_iter().collect()
    })
}

/// Lights anywhere and at infinity, and in the plane of a triangle, on its edge or on its corner, as nearly as single
/// precision can say.
fn light_of(mesh: &Mesh, kind: u8, triangle: usize, [u, v]: [f32; 2], anywhere: Vec3) -> Vec4 {
    let [a, b, c] = mesh.corners(triangle % mesh.triangles.len());
    match kind {
        0 => canonical(anywhere).extend(1.0),
        1 => canonical(anywhere).extend(0.0),
        2 => canonical(a + u * (b - a) + v * (c - a)).extend(1.0),
        3 => canonical(a + u * (b - a)).extend(1.0),
        4 => a.extend(1.0),
        _ => canonical(u * (b - a) + v * (c - a)).extend(0.0),
    }
}

/// Each edge by the facings of its triangles, one after the other.
fn by_definition(mesh: &Mesh, topology: &Topology, light: Vec4) -> Vec<SilhouetteEdge> {
    let question = Question {
        mesh,
        topology,
        light,
    };
    let edges = 0..topology.edges.len() as u32;
    edges.filter_map(|edge| question.ask(edge)).collect()
}

const NONE: SilhouetteEdge = SilhouetteEdge {
    edge: 0,
    multiplicity: 0,
};

fn sorted(found: &[SilhouetteEdge]) -> Vec<SilhouetteEdge> {
    let mut found = found.to_vec();
    found.sort_unstable();
    found
}

fn check(mesh: &Mesh, light: Vec4) -> Result<(), TestCaseError> {
    let topology = Topology::build(mesh);
    let expected = by_definition(mesh, &topology, light);
    // What was found before is replaced.
    let mut found = vec![expected.first().copied().unwrap_or(NONE); 3];
    BruteForce::build(mesh, &topology).silhouette(mesh, &topology, light, &mut found);
    prop_assert_eq!(&found, &expected);
    PlaneTree::build(mesh, &topology).silhouette(mesh, &topology, light, &mut found);
    prop_assert_eq!(&sorted(&found), &expected);
    for depth in [0, 1, hextree::DEPTH, 9] {
        Hextree::build(mesh, &topology, depth).silhouette(mesh, &topology, light, &mut found);
        prop_assert_eq!(&sorted(&found), &expected);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn trees_find_what_brute_force_finds_in_soups(
        mesh in soup(), kind in 0u8..6, triangle in any::<usize>(),
        uv in [-4.0f32..4.0, -4.0..4.0], anywhere in corner(),
    ) {
        check(&mesh, light_of(&mesh, kind, triangle, uv, anywhere))?;
    }

    #[test]
    fn trees_find_what_brute_force_finds_where_rounding_decides(
        mesh in flat(), kind in 2u8..6, triangle in any::<usize>(),
        uv in [-40.0f32..40.0, -40.0..40.0],
    ) {
        check(&mesh, light_of(&mesh, kind, triangle, uv, Vec3::ZERO))?;
    }

    #[test]
    fn trees_find_what_brute_force_finds_in_damaged_spheres(
        mesh in damaged(), kind in 0u8..6, triangle in any::<usize>(),
        uv in [-4.0f32..4.0, -4.0..4.0], anywhere in corner(),
    ) {
        check(&mesh, light_of(&mesh, kind, triangle, uv, anywhere))?;
    }
}

#[test]
fn the_silhouette_of_a_cube_from_afar_is_a_hexagon() {
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let quads = faces.map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let triangles: Vec<_> = quads.as_flattened().iter().map(|t| t.map(corner)).collect();
    let mesh: Mesh = [Part::of_triangles("cube", &triangles)]
        .into_iter()
        .collect();
    let topology = Topology::build(&mesh);
    let light = Vec4::new(3.0, 4.0, 5.0, 0.0);
    let mut found = Vec::new();
    PlaneTree::build(&mesh, &topology).silhouette(&mesh, &topology, light, &mut found);
    let found = sorted(&found);
    assert_eq!(found, by_definition(&mesh, &topology, light));
    assert_eq!(found.len(), 6);
    assert!(
        found.iter().all(|edge| edge.multiplicity.abs() == 2),
        "{found:?}"
    );
    // None of them is at the corner nearest to the light or at the farthest.
    let near_or_far = |v: u32| [Vec3::ZERO, Vec3::ONE].contains(&mesh.positions[v as usize]);
    let ends = found
        .iter()
        .map(|found| topology.edges[found.edge as usize]);
    assert!(!ends.flat_map(|edge| [edge.a, edge.b]).any(near_or_far));
}

/// The shares of the trial that the tree was built after: 17 % of the edges at 32,400 triangles.
#[test]
fn few_edges_of_a_sphere_grid_are_asked() {
    let grid = SphereGrid {
        rows: 10,
        columns: 10,
        slices: 18,
        shells: 1,
    };
    let mesh = grid.mesh().unwrap();
    let topology = Topology::build(&mesh);
    let light = Vec4::new(8.0, 45.0, 12.0, 1.0);
    let tree = PlaneTree::build(&mesh, &topology);
    let share = tree.asked(light) as f64 / topology.edges.len() as f64;
    assert!(share < 0.2, "{share}");
}

#[test]
fn no_edge_is_no_silhouette() {
    let mesh = Mesh::default();
    let topology = Topology::build(&mesh);
    let light = Vec4::new(1.0, 2.0, 3.0, 1.0);
    let mut found = vec![NONE];
    PlaneTree::build(&mesh, &topology).silhouette(&mesh, &topology, light, &mut found);
    assert_eq!(found, []);
    found.push(NONE);
    Hextree::build(&mesh, &topology, 4).silhouette(&mesh, &topology, light, &mut found);
    assert_eq!(found, []);
}
