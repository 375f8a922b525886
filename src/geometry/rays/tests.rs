#![allow(clippy::unwrap_used, reason = "tests")]

use super::*;
use crate::scene::{Mesh, Object};
use glam::{Mat4, Vec3, Vec4};
use proptest::prelude::*;

const SIZE_PX: [usize; 2] = [64, 48];

fn mesh(triangles: &[[Vec3; 3]], casts: impl Fn(usize) -> bool) -> Mesh {
    let mut mesh = Mesh::default();
    for (number, corners) in triangles.iter().enumerate() {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.triangles.push([first, first + 1, first + 2]);
        mesh.objects.push(Object {
            name: number.to_string(),
            triangles: number as u32..number as u32 + 1,
            vertices: first..first + 3,
            casts_shadow: casts(number),
        });
    }
    mesh
}

/// Looks down from `height` on a square of 2 × 1.5 around the origin at y = 0: x to the right, z downwards.
fn from_above(height: f32, light: Vec4) -> Picture {
    Picture {
        size_px: SIZE_PX,
        eye: Vec3::new(0.0, height, 0.0),
        clip_to_eye_ray: Mat4::from_cols(
            Vec4::X / height,
            -0.75 * Vec4::Z / height,
            Vec4::ZERO,
            -Vec4::Y,
        ),
        light,
    }
}

/// A square of side 2 `half` around a point, as two triangles.
fn square(middle: Vec3, half: f32) -> [[Vec3; 3]; 2] {
    let corner = |x: f32, z: f32| middle + half * Vec3::new(x, 0.0, z);
    let [a, b, c, d] =
        [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)].map(|(x, z)| corner(x, z));
    [[a, b, c], [a, c, d]]
}

/// What the ground shows of a square above it: pixel by pixel as computed by hand.
fn square_shadow(light: Vec4, expected: impl Fn(f32, f32) -> bool) {
    let [ground_a, ground_b] = square(Vec3::ZERO, 4.0);
    let [above_a, above_b] = square(Vec3::new(0.1, 1.0, 0.05), 0.2);
    let mesh = mesh(&[ground_a, ground_b, above_a, above_b], |_| true);
    let tree = RayTree::new(&mesh);
    let picture = from_above(8.0, light);
    let [width, height] = SIZE_PX;
    let place = |pixel: usize| {
        let x = (pixel % width) as f32 + 0.5;
        let y = (pixel / width) as f32 + 0.5;
        (
            2.0 * x / width as f32 - 1.0,
            0.75 * (2.0 * y / height as f32 - 1.0),
        )
    };
    // As if the square above were not in the way of the eye. The ground's triangles meet where x = z.
    let id = |pixel: usize| {
        let (x, z) = place(pixel);
        if x < z { 1 } else { 2 }
    };
    let ids: Vec<u32> = (0..width * height).map(id).collect();
    let mut mask = vec![0; ids.len()];
    picture.add_shadows(&mesh, &tree, &ids, &mut mask);
    let mut dark = 0;
    for (pixel, found) in mask.into_iter().enumerate() {
        let (x, z) = place(pixel);
        assert_eq!(found != 0, expected(x, z), "at {x}, {z}");
        dark += usize::from(found != 0);
    }
    assert!(dark > 100, "{dark} pixels in shadow");
}

#[test]
fn a_lamp_casts_a_larger_square() {
    // Seen from 3 above the ground, what is 1 above it is half as large again.
    square_shadow(Vec4::new(0.0, 3.0, 0.0, 1.0), |x, z| {
        (x - 0.15).abs() < 0.3 && (z - 0.075).abs() < 0.3
    });
}

#[test]
fn the_sun_casts_a_moved_square() {
    square_shadow(Vec4::new(0.5, 1.0, -0.25, 0.0), |x, z| {
        (x + 0.4).abs() < 0.2 && (z - 0.3).abs() < 0.2
    });
}

#[test]
fn what_does_not_cast_is_seen_and_blocks_nothing() {
    let [ground, _] = square(Vec3::ZERO, 4.0);
    let [above, _] = square(Vec3::Y, 4.0);
    let mask_with = |casts| {
        let mesh = mesh(&[ground, above], |number| number == 0 || casts);
        let mut mask = vec![0; SIZE_PX[0] * SIZE_PX[1]];
        let ids = vec![1; mask.len()];
        let picture = from_above(8.0, Vec4::Y);
        picture.add_shadows(&mesh, &RayTree::new(&mesh), &ids, &mut mask);
        mask.into_iter().filter(|pixel| *pixel != 0).count()
    };
    assert_eq!(mask_with(false), 0);
    assert!(mask_with(true) > SIZE_PX[0] * SIZE_PX[1] / 3);
}

#[test]
fn nothing_casts_where_there_is_nothing() {
    let [ground, _] = square(Vec3::ZERO, 4.0);
    let mesh = mesh(&[ground], |_| false);
    let tree = RayTree::new(&mesh);
    assert!(tree.triangles.is_empty() && tree.nodes.len() == 1);
    let mut mask = vec![0; SIZE_PX[0] * SIZE_PX[1]];
    let ids = vec![1; mask.len()];
    from_above(8.0, Vec4::Y).add_shadows(&mesh, &tree, &ids, &mut mask);
    assert!(mask.iter().all(|pixel| *pixel == 0));
}

/// A point on its own triangle, whatever its shape, is in contact with it.
fn own_light(corners: [Vec3; 3], weights: [f32; 2], light: Vec4) -> bool {
    let tree = RayTree::new(&mesh(&[corners], |_| true));
    let own = tree.triangles[0];
    let point = SurfacePoint::new(corners, weights);
    Blocker::new(&own, light).is_none_or(|blocker| !blocker.blocks(&own, &point))
}

fn vector(size: f32) -> impl Strategy<Value = Vec3> {
    [-size..size, -size..size, -size..size].prop_map(Vec3::from_array)
}

proptest! {
    #[test]
    fn no_triangle_shadows_itself(
        a in vector(100.0),
        e in vector(10.0),
        along in 0.0f32..1.0,
        aside in vector(1.0),
        thickness in -12..0,
        light in vector(200.0),
        u in 0.0f32..1.0,
        v in 0.0f32..1.0,
    ) {
        let c = a + along * e + aside * (thickness as f32).exp2();
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        prop_assert!(own_light([a, a + e, c], [u, v], light.extend(1.0)));
    }

    /// Through an edge of two triangles, no light passes between them.
    #[test]
    fn neighbours_leave_no_gap(
        a in vector(10.0),
        b in vector(10.0),
        c in vector(10.0),
        d in vector(10.0),
        light in vector(50.0),
        share in 0.0f32..1.0,
        beyond in 0.1f32..2.0,
    ) {
        let light = light + Vec3::Y * 60.0;
        // On different sides of the light plane through their edge.
        let side = |p: Vec3| (b - a).cross(light - a).dot(p - a);
        prop_assume!(side(c) * side(d) < -1.0);
        let mesh = mesh(&[[a, b, c], [b, a, d]], |_| true);
        let tree = RayTree::new(&mesh);
        let on_edge = a + share * (b - a);
        let place = on_edge + beyond * (on_edge - light);
        // What is seen is a small triangle there.
        let seen = [place, place + Vec3::X * 1e-3, place + Vec3::Z * 1e-3];
        let point = SurfacePoint::new(seen, [0.0, 0.0]);
        let light = light.extend(1.0);
        let blocks = |triangle: &RayTriangle| {
            Blocker::new(triangle, light).is_some_and(|blocker| blocker.blocks(triangle, &point))
        };
        prop_assert!(tree.triangles.iter().any(blocks));
    }

    /// Packets through the tree find what each triangle by itself says.
    #[test]
    fn the_tree_loses_nothing(
        corners in prop::collection::vec([vector(1.0), vector(0.3), vector(0.3)], 1..200),
        light in vector(3.0),
        is_lamp in any::<bool>(),
    ) {
        let [ground, other] = square(Vec3::ZERO, 40.0);
        let above = |[middle, e, x]: &[Vec3; 3]| {
            let middle = middle + Vec3::Y * 2.0;
            [middle, middle + e, middle + x]
        };
        let mut triangles = vec![ground, other];
        triangles.extend(corners.iter().map(above));
        let mesh = mesh(&triangles, |number| number > 1);
        let tree = RayTree::new(&mesh);
        let light = (light + Vec3::Y * 6.0).extend(if is_lamp { 1.0 } else { 0.0 });
        let picture = from_above(8.0, light);
        let ids = vec![1; SIZE_PX[0] * SIZE_PX[1]];
        let mut mask = vec![0; ids.len()];
        picture.add_shadows(&mesh, &tree, &ids, &mut mask);
        // In double precision, where that is sure.
        let sight = picture.clip_to_eye_ray.as_dmat4();
        let light = light.as_dvec4();
        for (pixel, found) in mask.into_iter().enumerate() {
            let x = (pixel % SIZE_PX[0]) as f64 + 0.5;
            let y = (pixel / SIZE_PX[0]) as f64 + 0.5;
            let ndc = glam::DVec4::new(2.0 * x / 64.0 - 1.0, 1.0 - 2.0 * y / 48.0, 0.0, 1.0);
            let ray = (sight * ndc).truncate();
            let eye = picture.eye.as_dvec3();
            let place = eye - ray * (eye.y / ray.y);
            // Beside the triangle that it is said to show, a pixel shows its edge.
            if place.x > place.z {
                continue;
            }
            let towards = light.truncate() - place * light.w;
            let margin = |corners: &[Vec3; 3]| {
                let [a, b, c] = corners.map(|corner| corner.as_dvec3() - place);
                let volume = |p: glam::DVec3, q: glam::DVec3| towards.dot(p.cross(q)) / towards.length();
                let (u, v, w) = (volume(a, b), volume(b, c), volume(c, a));
                u.min(v).min(w).max(-u.max(v).max(w))
            };
            let most = triangles[2..].iter().map(margin).fold(f64::NEG_INFINITY, f64::max);
            if most.abs() > 1e-4 {
                prop_assert_eq!(found != 0, most > 0.0, "at {}, by {}", place, most);
            }
        }
    }
}

/// An open sheet far from the origin, of triangles that meet in thousands of edges: rays through them all find one.
#[test]
fn a_sheet_far_away_has_no_gaps() {
    const SIDE: usize = 60;
    let middle = Vec3::new(700.0, 1.0, -900.0);
    let at = |i: usize, j: usize| {
        let height = 0.01 * ((i * 7 + j * 13) % 11) as f32;
        middle + Vec3::new(i as f32 / 20.0 - 1.5, height, j as f32 / 20.0 - 1.5)
    };
    let cells = (0..SIDE * SIDE).map(|cell| (cell % SIDE, cell / SIDE));
    let mut triangles: Vec<_> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let ground = middle - Vec3::Y;
    triangles.extend(square(ground, 4.0));
    let casting = triangles.len() - 2;
    let mesh = mesh(&triangles, |number| number < casting);
    let tree = RayTree::new(&mesh);
    let light = (ground + Vec3::new(0.3, 9.0, -0.2)).extend(1.0);
    let level = from_above(8.0, light);
    let picture = Picture {
        size_px: [640, 480],
        eye: level.eye + ground,
        ..level
    };
    let id = |pixel: usize| {
        let (x, z) = (pixel % 640, pixel / 640);
        let is_first = x as f32 - 320.0 < z as f32 - 240.0;
        casting as u32 + if is_first { 1 } else { 2 }
    };
    let ids: Vec<_> = (0..640 * 480).map(id).collect();
    let mut mask = vec![0; ids.len()];
    picture.add_shadows(&mesh, &tree, &ids, &mut mask);
    let lit = mask.iter().filter(|pixel| **pixel == 0).count();
    assert_eq!(lit, 0, "pixels lit through the sheet");
}

#[test]
fn a_tree_has_every_caster_once_and_says_how_much_may_wait() {
    let grid = crate::scene::sphere_grid::SphereGrid {
        rows: 3,
        columns: 4,
        slices: 12,
        shells: 1,
    };
    let mesh = grid.mesh().unwrap();
    let tree = RayTree::new(&mesh);
    let mut found = vec![0; mesh.triangles.len()];
    let mut waiting = vec![0];
    let mut most = 1;
    while let Some(node) = waiting.pop() {
        for child in tree.nodes[node as usize].children {
            match Node::triangles(child) {
                Some(triangles) => triangles.for_each(|at| {
                    found[tree.triangles[at].number as usize] += 1;
                }),
                None if child != 0 => waiting.push(child),
                None => {}
            }
        }
        most = most.max(waiting.len());
    }
    for object in &mesh.objects {
        let times = usize::from(object.casts_shadow);
        assert!(
            found[object.triangle_range()]
                .iter()
                .all(|found| *found == times)
        );
    }
    assert!(most <= tree.stack, "{most} wait, {} said", tree.stack);
}
