use super::*;
use crate::geometry::Topology;
use crate::scene::{Light, Mesh, Part, SphereGrid};
use crate::stress::fixtures::small_grid;
use glam::{DVec3, Vec3};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

fn apply(change: Change, scene: &Scene) -> Option<Changed> {
    change.apply(scene, &mut ChaCha8Rng::seed_from_u64(3))
}

/// The corners of each triangle as bits, wherever a triangle begins and whichever way it is wound.
fn triangles(mesh: &Mesh) -> Vec<[[u32; 3]; 3]> {
    let corners = |t: usize| {
        let mut corners = mesh.corners(t).map(|p| p.to_array().map(f32::to_bits));
        corners.sort_unstable();
        corners
    };
    (0..mesh.triangles.len()).map(corners).collect()
}

fn sorted<T: Ord>(mut values: Vec<T>) -> Vec<T> {
    values.sort_unstable();
    values
}

/// Twice the area vector of each triangle.
fn normals(mesh: &Mesh) -> Vec<DVec3> {
    let normal = |t: usize| {
        let [a, b, c] = mesh.corners(t).map(|p| p.as_dvec3());
        (b - a).cross(c - a)
    };
    (0..mesh.triangles.len()).map(normal).collect()
}

#[test]
fn what_keeps_every_pixel_keeps_every_triangle() {
    let scene = small_grid();
    let before = triangles(&scene.mesh);
    for change in Change::ALL {
        let exact = !matches!(change, Change::Scale | Change::Subdivide);
        let Some(changed) = apply(change, &scene).filter(|_| exact) else {
            continue;
        };
        let after = triangles(&changed.scene.mesh);
        let from: Vec<_> = changed
            .origins
            .iter()
            .map(|t| before[*t as usize])
            .collect();
        assert_eq!(after, from, "{change:?}");
        assert_eq!(sorted(after), sorted(before.clone()), "{change:?}");
        let is_same = changed.scene.mesh_hash == scene.mesh_hash;
        assert_eq!(is_same, change == Change::Again, "{change:?}");
        let mesh = &changed.scene.mesh;
        let cast = |mesh: &Mesh| mesh.caster_triangle_count();
        assert_eq!(cast(mesh), cast(&scene.mesh), "{change:?}");
        assert_eq!(mesh.hash(), changed.scene.mesh_hash, "{change:?}");
    }
}

#[test]
fn objects_own_their_vertices_and_triangles() {
    let scene = small_grid();
    for change in Change::ALL {
        let Some(Changed { scene, origins }) = apply(change, &scene) else {
            panic!("{change:?} does not apply");
        };
        let mesh = &scene.mesh;
        assert_eq!(origins.len(), mesh.triangles.len(), "{change:?}");
        let (mut vertex, mut triangle) = (0, 0);
        for object in &mesh.objects {
            assert_eq!(
                (object.vertices.start, object.triangles.start),
                (vertex, triangle)
            );
            (vertex, triangle) = (object.vertices.end, object.triangles.end);
            let corners = mesh.triangles[object.triangle_range()].as_flattened();
            assert!(
                corners.iter().all(|v| object.vertices.contains(v)),
                "{change:?}"
            );
        }
        let ends = (mesh.positions.len(), mesh.triangles.len());
        assert_eq!((vertex as usize, triangle as usize), ends, "{change:?}");
    }
}

#[test]
fn objects_are_split_merged_and_reordered() {
    let scene = small_grid();
    let after = |change| apply(change, &scene).unwrap().scene.mesh;
    let counts = |mesh: &Mesh| (mesh.caster_object_count(), mesh.objects.len());
    assert_eq!(counts(&scene.mesh), (4, 5));
    assert_eq!(counts(&after(Change::SplitObjects)), (8, 10));
    assert_eq!(counts(&after(Change::MergeObjects)), (1, 2));
    let reordered = after(Change::ReorderObjects);
    assert_eq!(counts(&reordered), (4, 5));
    let names = |mesh: &Mesh| {
        mesh.objects
            .iter()
            .map(|o| o.name.clone())
            .collect::<Vec<_>>()
    };
    assert_ne!(names(&reordered), names(&scene.mesh));
    assert_eq!(sorted(names(&reordered)), sorted(names(&scene.mesh)));
    // Vertices of both halves at one place are one again.
    let mut split = scene.clone();
    split.mesh = after(Change::SplitObjects);
    assert!(split.mesh.positions.len() > scene.mesh.positions.len());
    let merged = apply(Change::MergeObjects, &split).unwrap().scene.mesh;
    assert_eq!(merged.positions.len(), scene.mesh.positions.len());
}

#[test]
fn closed_objects_are_turned_inside_out_and_open_ones_left() {
    let scene = small_grid();
    let flipped = apply(Change::FlipClosedObjects, &scene).unwrap().scene.mesh;
    let (before, after) = (normals(&scene.mesh), normals(&flipped));
    for object in &scene.mesh.objects {
        let sign = if object.casts_shadow { -1.0 } else { 1.0 };
        assert!(
            object
                .triangle_range()
                .all(|t| after[t] == sign * before[t])
        );
    }
    let mut open = scene.clone();
    let grid = SphereGrid {
        rows: 1,
        columns: 1,
        slices: 6,
        shells: 1,
    };
    open.mesh = Arc::new(grid.mesh().unwrap());
    assert!(apply(Change::FlipClosedObjects, &open).is_some());
    Arc::make_mut(&mut open.mesh).triangles[3].swap(0, 1);
    assert!(
        apply(Change::FlipClosedObjects, &open).is_none(),
        "not oriented"
    );
    let mesh = Arc::make_mut(&mut open.mesh);
    mesh.triangles[3] = mesh.triangles[4];
    assert!(
        apply(Change::FlipClosedObjects, &open).is_none(),
        "not closed"
    );
}

#[test]
fn some_triangles_are_flipped_and_some_are_rotated() {
    let scene = small_grid();
    let before = normals(&scene.mesh);
    let flips = |change| {
        let after = normals(&apply(change, &scene).unwrap().scene.mesh);
        let flipped = |(b, a): &(&DVec3, &DVec3)| b.dot(**a) < 0.0;
        before.iter().zip(&after).filter(flipped).count()
    };
    let count = scene.mesh.triangles.len();
    assert!((count / 3..2 * count / 3).contains(&flips(Change::FlipTriangles)));
    assert_eq!(flips(Change::RotateVertices), 0);
}

#[test]
fn quarters_cover_the_whole() {
    let scene = small_grid();
    let Changed {
        scene: cut,
        origins,
    } = apply(Change::Subdivide, &scene).unwrap();
    assert_eq!(cut.mesh.triangles.len(), 4 * scene.mesh.triangles.len());
    let counts = |mesh: &Mesh| Topology::build(mesh).counts();
    assert!(counts(&cut.mesh).is_closed_manifold());
    assert_eq!(counts(&cut.mesh).manifold, 4 * counts(&scene.mesh).manifold);
    let mut sums = vec![DVec3::ZERO; scene.mesh.triangles.len()];
    for (normal, origin) in normals(&cut.mesh).into_iter().zip(origins) {
        sums[origin as usize] += normal;
    }
    for (sum, whole) in sums.iter().zip(normals(&scene.mesh)) {
        assert!(
            (*sum - whole).length() < 1e-4 * whole.length() + 1e-6,
            "{sum} {whole}"
        );
    }
}

#[test]
fn scaling_takes_light_and_camera_along() {
    let scene = small_grid();
    let scaled = apply(Change::Scale, &scene).unwrap().scene;
    let factor = scaled.mesh.positions[0].y / scene.mesh.positions[0].y;
    assert!(factor >= 2.0 && factor.log2().fract() == 0.0, "{factor}");
    assert_eq!(
        scaled.flight.at(0.0).light.place.truncate(),
        scene.flight.at(0.0).light.place.truncate() * factor
    );
    let (before, after) = (scene.flight.at(1.5).view, scaled.flight.at(1.5).view);
    assert_eq!(after.eye, before.eye * factor);
    assert_eq!(after.target, before.target * factor);
    assert_eq!(after.near, before.near * factor);
    let directional = scene.clone().with_light(Light::at(glam::Vec4::Y));
    assert_eq!(
        apply(Change::Scale, &directional)
            .unwrap()
            .scene
            .flight
            .light,
        directional.flight.light
    );
    let mut huge = scene;
    Arc::make_mut(&mut huge.mesh).positions[0].x = 9e8;
    assert!(apply(Change::Scale, &huge).is_none());
}

#[test]
fn one_object_cannot_be_merged_nor_one_triangle_split() {
    let mut scene = small_grid();
    let one = Part::of_triangles("one", &[[Vec3::ZERO, Vec3::X, Vec3::Y]]);
    scene.mesh = Arc::new([one].into_iter().collect());
    for change in [
        Change::MergeObjects,
        Change::SplitObjects,
        Change::ReorderObjects,
    ] {
        assert!(apply(change, &scene).is_none(), "{change:?}");
    }
}

#[test]
fn ids_differ() {
    let ids = sorted(Change::ALL.map(Change::id).to_vec());
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]));
    assert!(Change::ALL.iter().all(|change| !change.title().is_empty()));
}
