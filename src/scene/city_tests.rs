use super::*;
use crate::geometry::{EdgeTriangles, Topology};

const CITY: City = City {
    objects: 150,
    seed: 17,
    ledges: 1,
    tree_triangles: 0,
};

#[test]
fn a_city_has_as_many_objects_as_asked_for_on_a_ground_that_receives() {
    for objects in [1, 7, 150, 1000] {
        let mesh = City { objects, ..CITY }.mesh().unwrap();
        assert_eq!(mesh.caster_object_count(), objects as usize);
        assert_eq!(mesh.objects.len(), objects as usize + 1);
        let ground = mesh.objects.last().unwrap();
        let (low, high) = mesh.caster_bounds();
        let [a, b, c] = mesh.corners(ground.triangles.start as usize);
        assert!((b - a).cross(c - a).y > 0.0, "it faces up");
        assert!(a.x < low.x && a.z > high.z && b.x > high.x);
    }
}

#[test]
fn a_larger_city_is_a_smaller_one_with_more_around_it() {
    let small = CITY.mesh().unwrap();
    let large = City {
        objects: 400,
        ..CITY
    }
    .mesh()
    .unwrap();
    let shared = small.caster_triangle_count();
    assert_eq!(small.triangles[..shared], large.triangles[..shared]);
    let last = &small.objects[CITY.objects as usize - 1];
    let vertices = last.vertices.end as usize;
    assert_eq!(small.positions[..vertices], large.positions[..vertices]);
}

#[test]
fn the_seed_decides() {
    let other = City { seed: 18, ..CITY };
    assert_eq!(CITY.mesh().unwrap(), CITY.mesh().unwrap());
    assert_ne!(CITY.mesh().unwrap(), other.mesh().unwrap());
}

#[test]
fn buildings_are_closed_and_trees_are_not() {
    let mesh = City {
        objects: 1000,
        ..CITY
    }
    .mesh()
    .unwrap();
    let topology = Topology::build(&mesh);
    let closed = EdgeTriangles::build(&mesh, &topology).closed_casters(&mesh, &topology);
    for (object, is_closed) in mesh.casters().zip(closed) {
        assert_eq!(is_closed, object.name != "tree", "{}", object.name);
    }
    for kind in ["house", "courtyard", "tower", "tree"] {
        assert!(mesh.objects.iter().any(|o| o.name == kind), "{kind}");
    }
}

/// Six times the volume that closed objects enclose is positive where they are wound counter-clockwise seen from outside.
#[test]
fn buildings_face_outwards() {
    let mesh = CITY.mesh().unwrap();
    for object in mesh.casters().filter(|object| object.name != "tree") {
        let volumes = object.triangle_range().map(|triangle| {
            let [a, b, c] = mesh.corners(triangle).map(Vec3::as_dvec3);
            a.dot(b.cross(c))
        });
        assert!(volumes.sum::<f64>() > 0.0, "{}", object.name);
    }
}

#[test]
fn streets_are_free() {
    let mesh = City {
        objects: 1000,
        ..CITY
    }
    .mesh()
    .unwrap();
    for object in mesh.casters() {
        for p in &mesh.positions[object.vertex_range()] {
            let from_street =
                |along: f32| (along / PITCH_M - (along / PITCH_M).round()).abs() * PITCH_M;
            let nearest = from_street(p.x).min(from_street(p.z));
            assert!(nearest > 6.0, "{} at {p}", object.name);
        }
    }
}

#[test]
fn the_tree_on_the_square_has_as_many_triangles_as_asked_for() {
    let city = City {
        objects: 2,
        tree_triangles: 5000,
        ..CITY
    };
    let mesh = city.mesh().unwrap();
    let trees = mesh.casters().map(|object| object.triangles.len());
    assert_eq!(trees.max(), Some(5000));
}

#[test]
fn numbers_out_of_range_are_refused() {
    let refused = |city: City| city.mesh().unwrap_err().to_string();
    let none = refused(City { objects: 0, ..CITY });
    assert!(none.contains("`objects` is 0"), "{none}");
    let ledges = refused(City { ledges: 17, ..CITY });
    assert!(ledges.contains("from 0 to 16"), "{ledges}");
}
