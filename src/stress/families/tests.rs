use super::*;
use crate::geometry::{EdgeCounts, Topology, facing};
use crate::scene::{Mesh, Object};

fn scene(family: Family, value: f64, seed: u64) -> Scene {
    assert_eq!(family.refusal(value), None);
    family.scene(value, seed, "test".into(), "Test".into())
}

/// The objects of this name alone.
fn only(scene: &Scene, name: &str) -> Mesh {
    let objects: Vec<Object> = scene.mesh.objects.clone();
    let objects: Vec<_> = objects
        .into_iter()
        .filter(|o| o.name.starts_with(name))
        .collect();
    assert!(!objects.is_empty(), "{name}");
    Mesh {
        objects,
        ..Mesh::clone(&scene.mesh)
    }
}

fn edges(scene: &Scene, name: &str) -> EdgeCounts {
    Topology::build(&only(scene, name)).counts()
}

#[test]
fn families_refuse_what_they_cannot_take() {
    let refused = [
        (Family::Fan, 0.0),
        (Family::Fan, 1.5),
        (Family::Fan, -1.0),
        (Family::Fan, 1e9),
        (Family::Flipped, 1.01),
        (Family::Flipped, -0.1),
        (Family::Moebius, 2.0),
        (Family::OpenMesh, 256.0),
        (Family::LightAtInfinity, 90.0),
        (Family::Translation, f64::NAN),
        (Family::ScaleUp, f64::INFINITY),
    ];
    for (family, value) in refused {
        assert!(family.refusal(value).is_some(), "{family:?} {value}");
    }
}

#[test]
fn all_pages_of_a_fan_are_on_one_edge_and_on_one_side_of_its_light_plane() {
    for (pages, seed) in [(1, 0), (3, 1), (64, 2), (300, 3)] {
        let scene = scene(Family::Fan, f64::from(pages), seed);
        let mesh = only(&scene, "fan");
        let topology = Topology::build(&mesh);
        let most = topology
            .edges
            .iter()
            .max_by_key(|edge| edge.opposite_count)
            .unwrap();
        assert_eq!(most.opposite_count, pages);
        let at = |vertex: u32| mesh.positions[vertex as usize];
        let multiplicity: i32 = topology
            .opposites_of(*most)
            .iter()
            .map(|&opposite| {
                facing(
                    at(most.a),
                    at(most.b),
                    at(opposite),
                    scene.flight.at(0.0).light.place,
                )
            })
            .sum();
        assert_eq!(multiplicity.unsigned_abs(), pages);
    }
}

#[test]
fn shells_are_closed_and_sheets_are_not() {
    let shells = scene(Family::NestedShells, 7.0, 0);
    assert!(edges(&shells, "shells").is_closed_manifold());
    assert_eq!(shells.mesh.objects[0].triangles.len(), 7 * 36);
    let sheets = scene(Family::StackedSheets, 7.0, 0);
    let counts = edges(&sheets, "sheets");
    assert_eq!(
        (counts.boundary, counts.manifold, counts.non_manifold),
        (28, 7, 0)
    );
}

#[test]
fn holes_flips_copies_and_cracks_are_as_many_as_asked_for() {
    let whole = scene(Family::OpenMesh, 0.0, 1);
    assert!(edges(&whole, "sphere").is_closed_manifold());
    let holes = scene(Family::OpenMesh, 1.0, 1);
    assert_eq!(edges(&holes, "sphere").boundary, 3);
    assert_eq!(holes.mesh.objects[0].triangles.len(), 255);

    for (share, expected) in [(0.0, 0), (0.25, 64), (1.0, 256)] {
        let flipped = scene(Family::Flipped, share, 4);
        let mesh = only(&flipped, "sphere");
        let inwards = mesh.objects[0].triangle_range().filter(|&triangle| {
            let [a, b, c] = mesh.corners(triangle);
            (b - a).cross(c - a).dot(a - glam::Vec3::Y * 1.3) < 0.0
        });
        assert_eq!(inwards.count(), expected);
    }

    let copies = scene(Family::Duplicated, 5.0, 1);
    let topology = Topology::build(&only(&copies, "sphere"));
    assert!(topology.edges.iter().all(|edge| edge.opposite_count == 10));

    let cracks = scene(Family::TJunctions, 64.0, 1);
    assert_eq!(edges(&cracks, "sphere").boundary, 3 * 64);

    let flat = scene(Family::Collinear, 1.0, 1);
    let counts = edges(&flat, "sphere");
    assert_eq!((counts.manifold, counts.non_manifold), (0, 144 * 3 / 2));
}

#[test]
fn a_moebius_strip_has_a_boundary_and_a_klein_bottle_none() {
    for segments in [3, 5, 32] {
        let strip = scene(Family::Moebius, f64::from(segments), 0);
        let counts = edges(&strip, "strip");
        assert_eq!(counts.boundary, 2 * segments as usize);
        assert_eq!(counts.non_manifold, 0);
    }
    for segments in [4, 6, 7, 32] {
        let bottle = scene(Family::KleinBottle, f64::from(segments), 0);
        assert!(edges(&bottle, "bottle").is_closed_manifold(), "{segments}");
        let vertices = bottle.mesh.objects[0].vertices.len();
        assert_eq!(vertices, (segments * segments) as usize);
    }
}

#[test]
fn solids_are_closed_and_wound_outwards() {
    let solids = [
        (Family::EyeInVolume, 0.0, "plate"),
        (Family::ThinWall, 2.0, "wall"),
        (Family::Needles, 3.0, "prism"),
        (Family::EdgeOn, 0.0, "frustum"),
        (Family::LightNearFace, 1.0, "body"),
        (Family::LightNearEdge, 1.0, "body"),
        (Family::LightNearVertex, 1.0, "body"),
        (Family::SelfIntersections, 3.0, "sphere"),
        (Family::ScaleDown, 0.0, "leaning box"),
    ];
    for (family, value, name) in solids {
        let scene = scene(family, value, 1);
        let mesh = only(&scene, name);
        assert!(
            Topology::build(&mesh).counts().is_closed_manifold(),
            "{name}"
        );
        for object in &mesh.objects {
            let middle = mesh.positions[object.vertex_range()]
                .iter()
                .sum::<glam::Vec3>()
                / object.vertices.len() as f32;
            let volumes = object.triangle_range().map(|triangle| {
                let [a, b, c] = mesh.corners(triangle).map(|p| (p - middle).as_dvec3());
                a.dot(b.cross(c))
            });
            assert!(volumes.clone().all(|volume| volume > 0.0), "{name}");
        }
    }
}

#[test]
fn the_light_is_where_it_should_be() {
    let scene = scene(Family::LightOnElement, 3.0, 0);
    let mesh = only(&scene, "body");
    let sums = mesh.objects[0]
        .triangle_range()
        .map(|t| mesh.corners(t).iter().sum::<glam::Vec3>());
    assert!(sums.into_iter().any(|sum| sum == glam::Vec3::ZERO));
    assert_eq!(scene.flight.at(0.0).light.place, glam::Vec4::W);
}
