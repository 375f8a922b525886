//! What the methods must get right beside closed spheres: open and non-manifold meshes, lights at
//! infinity, and the same answer every time.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{device, scene_over_ground};
use glam::{Vec3, Vec4};
use svbench::bench::Verifier;
use svbench::frame::Stage;
use svbench::gpu::Gpu;
use svbench::methods::{PrepareContext, parameters::parse_method};
use svbench::metrics::MaskError;
use svbench::reference::ReferenceCache;
use svbench::scene::{Scene, View};

const SIZE_PX: (u32, u32) = (320, 240);
const POINT_LIGHT: Vec4 = Vec4::new(2.0, 9.0, 1.5, 1.0);

fn view() -> View {
    View {
        eye: Vec3::new(5.0, 6.0, 9.0),
        target: Vec3::new(0.0, 0.5, 0.0),
        up: Vec3::Y,
        fov_y_rad: 50f32.to_radians(),
        near: 0.1,
    }
}

/// Mask and errors of one frame.
fn draw(gpu: &Gpu, scene: &Scene, method: &str) -> (Vec<u8>, MaskError) {
    let stage = Stage::new(gpu, scene, SIZE_PX.0, SIZE_PX.1);
    let context = PrepareContext::new(gpu, scene, &stage);
    let prepared = parse_method(method).unwrap().prepare(&context).unwrap();
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(gpu, scene, &stage, &cache).unwrap();
    let truth = verifier.truth(&scene.camera.view_at(0.0)).unwrap();
    let mask = verifier.draw_mask(prepared.as_ref()).unwrap();
    let error = verifier.judge(&mask, &truth).unwrap().error;
    (mask, error)
}

/// `pages` triangles on one edge, like an open book.
fn fan(pages: u32) -> Vec<[Vec3; 3]> {
    let (a, b) = (Vec3::new(-0.1, 1.2, -1.3), Vec3::new(0.2, 1.9, 1.4));
    let page = |i: u32| {
        let angle = 0.1 + std::f32::consts::TAU * i as f32 / pages as f32;
        [
            a,
            b,
            Vec3::new(1.5 * angle.cos(), 1.6 + 1.4 * angle.sin(), 0.13),
        ]
    };
    (0..pages).map(page).collect()
}

#[test]
fn a_fan_of_any_number_of_pages_is_right() {
    let gpu = device();
    for pages in [1, 2, 3, 5, 32, 33, 70, 120] {
        let scene = scene_over_ground(&fan(pages), 0.0, POINT_LIGHT, &view());
        for method in [
            "silhouette_ts",
            "silhouette_ts,max_multiplicity=1",
            "silhouette_ts,max_multiplicity=7",
            "silhouette_gs",
            "silhouette_gs,max_multiplicity=3",
            "silhouette_gs,max_multiplicity=64",
        ] {
            let (mask, error) = draw(&gpu, &scene, method);
            assert!(mask.contains(&255), "{pages} pages cast a shadow");
            assert_eq!(error.artifact_px, 0, "{method}, {pages} pages: {error:?}");
            assert!(error.wrong_px() <= 4, "{method}, {pages} pages: {error:?}");
        }
    }
}

#[test]
fn winding_and_duplicates_do_not_matter() {
    let gpu = device();
    let right = fan(7);
    let mut turned = right.clone();
    for (i, triangle) in turned.iter_mut().enumerate() {
        // Swaps and rotations: every order of three corners.
        triangle.rotate_left(i % 3);
        if i % 2 == 1 {
            triangle.swap(0, 1);
        }
    }
    let doubled: Vec<_> = right.iter().chain(&turned).copied().collect();
    for method in ["silhouette_ts", "silhouette_gs"] {
        let mask = |triangles: &[[Vec3; 3]]| {
            draw(
                &gpu,
                &scene_over_ground(triangles, 0.0, POINT_LIGHT, &view()),
                method,
            )
            .0
        };
        let expected = mask(&right);
        let differing = |other: &[u8]| expected.iter().zip(other).filter(|(a, b)| a != b).count();
        assert!(differing(&mask(&turned)) <= 2, "{method}: winding");
        assert!(
            differing(&mask(&doubled)) <= 2,
            "{method}: every triangle twice"
        );
    }
}

#[test]
fn degenerate_triangles_are_harmless() {
    let gpu = device();
    let mut triangles = fan(5);
    let [a, b, c] = triangles[0];
    triangles.extend([[a, a, b], [b, c, b], [a, a, a], [a, b, (a + b) / 2.0]]);
    let scene = scene_over_ground(&triangles, 0.0, POINT_LIGHT, &view());
    for method in ["silhouette_ts", "silhouette_gs"] {
        let (_, error) = draw(&gpu, &scene, method);
        assert_eq!(error.artifact_px, 0, "{method}: {error:?}");
    }
}

#[test]
fn a_light_at_infinity_and_an_eye_in_shadow_are_right() {
    let gpu = device();
    let from_below = View {
        eye: Vec3::new(0.3, 0.6, 0.4),
        target: Vec3::new(1.5, 0.0, 0.6),
        ..view()
    };
    for (light, view) in [
        (Vec4::new(0.3, 1.0, 0.2, 0.0), view()),
        (Vec4::new(0.3, 1.0, 0.2, 0.0), from_below),
        (POINT_LIGHT, from_below),
    ] {
        let scene = scene_over_ground(&fan(9), 0.0, light, &view);
        for method in ["silhouette_ts", "silhouette_gs"] {
            let (mask, error) = draw(&gpu, &scene, method);
            assert!(mask.contains(&255) && mask.contains(&0));
            assert_eq!(error.artifact_px, 0, "{method}, light {light}: {error:?}");
        }
    }
}

#[test]
fn a_square_casts_the_shadow_that_geometry_says() {
    // A square of side 2 at half the height of the light: its shadow is a square of side 4.
    let gpu = device();
    let corner = |x: f32, z: f32| Vec3::new(x, 4.0, z);
    let (a, b, c, d) = (
        corner(-1., -1.),
        corner(-1., 1.),
        corner(1., -1.),
        corner(1., 1.),
    );
    let light = Vec4::new(0.0, 8.0, 0.0, 1.0);
    let view = View {
        eye: Vec3::new(0.0, 12.0, 0.0),
        target: Vec3::ZERO,
        up: Vec3::Z,
        ..view()
    };
    let scene = scene_over_ground(&[[a, b, c], [c, b, d]], 0.0, light, &view);
    let px_per_unit = 240.0 / 2.0 / (12.0 * (0.5 * view.fov_y_rad).tan());
    for (method, tolerance) in [
        ("silhouette_ts", 1.0),
        ("silhouette_gs", 1.0),
        ("shadow_map,resolution=4096", 2.0),
    ] {
        let (mask, _) = draw(&gpu, &scene, method);
        let row = &mask[120 * 320..121 * 320];
        // Everything but the square itself, lit from above, which hides the middle of its shadow.
        let first = row.iter().position(|&m| m == 255).unwrap() as f32;
        let last = row.iter().rposition(|&m| m == 255).unwrap() as f32 + 1.0;
        let expected = 2.0 * px_per_unit;
        assert!(
            (160.0 - first - expected).abs() <= tolerance,
            "{method}: {first} {expected}"
        );
        assert!(
            (last - 160.0 - expected).abs() <= tolerance,
            "{method}: {last} {expected}"
        );
        assert_eq!(row[160], 0, "{method}: the square itself is lit");
    }
}

#[test]
fn the_same_frame_is_the_same() {
    let gpu = device();
    let scene = scene_over_ground(&fan(11), 0.0, POINT_LIGHT, &view());
    for method in [
        "silhouette_ts",
        "silhouette_gs",
        "shadow_map,resolution=512",
    ] {
        assert_eq!(
            draw(&gpu, &scene, method).0,
            draw(&gpu, &scene, method).0,
            "{method}"
        );
    }
}

#[test]
fn a_map_without_bias_has_acne_and_the_default_has_little() {
    let gpu = device();
    let scene = scene_over_ground(&fan(3), 0.0, POINT_LIGHT, &view());
    let artifacts = |method: &str| draw(&gpu, &scene, method).1.artifact_px;
    let none = artifacts("shadow_map,resolution=256,constant_bias=0,slope_bias=0.0");
    let default = artifacts("shadow_map,resolution=256");
    assert!(
        none > 10 * default.max(5),
        "without bias {none}, by default {default}"
    );
}
