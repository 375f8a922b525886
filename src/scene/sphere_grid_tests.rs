use super::*;
use crate::geometry::Topology;

fn grid(rows: u32, columns: u32, slices: u32) -> SphereGrid {
    SphereGrid {
        rows,
        columns,
        slices,
        shells: 1,
    }
}

#[test]
fn ten_by_ten_has_the_counts_of_the_paper() {
    let published = [
        (18, 32_400),
        (26, 67_600),
        (32, 102_400),
        (60, 360_000),
        (104, 1_081_600),
        (120, 1_440_000),
        (140, 1_960_000),
        (200, 4_000_000),
    ];
    for (slices, triangles) in published {
        let mesh = grid(10, 10, slices).mesh().unwrap();
        assert_eq!(
            (mesh.caster_triangle_count(), mesh.caster_object_count()),
            (triangles, 100)
        );
    }
}

#[test]
fn a_million_triangles_in_one_to_15600_objects_are_within_two_percent() {
    let table_2 = [
        (1, 1, 1000),
        (2, 2, 500),
        (5, 5, 200),
        (8, 8, 126),
        (10, 10, 100),
        (15, 16, 64),
        (19, 21, 50),
        (25, 25, 40),
        (23, 37, 34),
        (25, 50, 28),
        (50, 50, 20),
        (38, 82, 18),
        (56, 70, 16),
        (68, 75, 14),
        (120, 130, 8),
    ];
    for (rows, columns, slices) in table_2 {
        let mesh = grid(rows, columns, slices).mesh().unwrap();
        let triangles = mesh.caster_triangle_count();
        assert!(
            triangles.abs_diff(1_000_000) <= 20_000,
            "{rows} × {columns}: {triangles}"
        );
        assert_eq!(mesh.caster_object_count() as u32, rows * columns);
        assert_eq!(mesh.objects.len() as u32, rows * columns + 1);
    }
}

#[test]
fn spheres_are_closed_and_euler_is_right() {
    for slices in [4, 6, 8, 18, 26, 100] {
        let mesh = grid(2, 3, slices).mesh().unwrap();
        let topology = Topology::build(&mesh);
        assert!(topology.counts().is_closed_manifold());
        for (object, edges) in mesh.objects.iter().zip(&topology.object_edges) {
            let (v, e, f) = (object.vertices.len(), edges.len(), object.triangles.len());
            if object.casts_shadow {
                assert_eq!(f as u32, slices * slices);
                assert_eq!(v + f, e + 2);
            } else {
                assert_eq!((v, e, f), (4, 0, 2));
            }
        }
    }
}

#[test]
fn triangles_look_counter_clockwise_from_outside() {
    for (rows, columns, slices) in [(1, 1, 4), (3, 2, 18), (1, 1, 200), (120, 130, 8)] {
        let grid = grid(rows, columns, slices);
        let mesh = grid.mesh().unwrap();
        for (i, object) in mesh.objects.iter().enumerate() {
            let inside = if object.casts_shadow {
                grid.centre(i)
            } else {
                Vec3::NEG_Y
            };
            for t in object.triangle_range() {
                let [a, b, c] = mesh.corners(t);
                assert!((b - a).cross(c - a).dot(a - inside) > 0.0);
            }
        }
    }
}

#[test]
fn the_longer_side_spans_25_units() {
    let ten = grid(10, 10, 18);
    assert_eq!((ten.radius(), ten.spacing()), (1.0, 2.5));
    assert_eq!(ten.centre(0), Vec3::new(-11.25, 1.25, -11.25));
    assert_eq!(ten.centre(99), Vec3::new(11.25, 1.25, 11.25));
    let one = grid(1, 1, 1000);
    assert_eq!(
        (one.radius(), one.centre(0)),
        (10.0, Vec3::new(0.0, 12.5, 0.0))
    );
    assert_eq!(grid(15, 16, 64).spacing(), 25.0 / 16.0);
    let (low, high) = ten.mesh().unwrap().bounds();
    assert_eq!(
        (low, high),
        (Vec3::new(-40.0, 0.0, -40.0), Vec3::new(40.0, 2.25, 40.0))
    );
}

#[test]
fn impossible_grids_are_refused() {
    use SphereGridError::{NoSpheres, Slices, TooLarge};
    assert_eq!(
        grid(0, 1, 8).mesh(),
        Err(NoSpheres {
            rows: 0,
            columns: 1,
            shells: 1
        })
    );
    assert_eq!(grid(1, 1, 9).mesh(), Err(Slices { slices: 9 }));
    assert_eq!(grid(1, 1, 2).mesh(), Err(Slices { slices: 2 }));
    let most = u32::MAX;
    let too_large = TooLarge {
        rows: most,
        columns: most,
        slices: most - 1,
        shells: 1,
    };
    assert_eq!(grid(most, most, most - 1).validate(), Err(too_large));
}

#[test]
fn shells_are_nested_by_equal_steps() {
    let grid = SphereGrid {
        shells: 4,
        ..grid(1, 2, 8)
    };
    let mesh = grid.mesh().unwrap();
    assert_eq!(mesh.caster_object_count(), 8);
    assert_eq!(mesh.caster_triangle_count(), 8 * 64);
    let largest = grid.radius();
    for (i, sphere) in mesh.objects[..8].iter().enumerate() {
        let positions = &mesh.positions[sphere.vertex_range()];
        let centre = grid.centre(i);
        assert_eq!(centre, grid.centre(i / 4 * 4), "all shells of a place");
        let expected = largest * (4 - i % 4) as f32 / 4.0;
        for position in positions {
            assert!(((*position - centre).length() - expected).abs() < 1e-5);
        }
    }
    assert_eq!(mesh.objects[5].name, "sphere r0 c1 s1");
    let none = SphereGrid { shells: 0, ..grid };
    assert!(matches!(
        none.mesh(),
        Err(SphereGridError::NoSpheres { .. })
    ));
}
