//! What the methods must get right beside closed spheres: open and non-manifold meshes, lights at
//! infinity, and the same answer every time.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{box_edge_on_to_the_light, device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use std::path::Path;
use svbench::config::find_scene;
use svbench::frame::FrameResources;
use svbench::gpu::{Gpu, readback};
use svbench::judge::Verifier;
use svbench::methods::{PrepareContext, Registry};
use svbench::metrics::MaskError;
use svbench::reference::ReferenceCache;
use svbench::scene::{Scene, View};

const SIZE_PX: (u32, u32) = (320, 240);
const POINT_LIGHT: Vec4 = Vec4::new(2.0, 9.0, 1.5, 1.0);
const SILHOUETTES: [&str; 4] = [
    "silhouette_ts",
    "silhouette_gs",
    "silhouette_ts,input=storage",
    "silhouette_gs,input=storage",
];
const TRIANGLES: [&str; 5] = [
    "triangle_ts",
    "triangle_ts,passes=1",
    "triangle_gs",
    "adjacency_gs,mode=robust",
    "adjacency_gs,mode=robust,determinism=any_corner",
];

fn volume_methods() -> impl Iterator<Item = &'static str> {
    SILHOUETTES.into_iter().chain(TRIANGLES)
}

/// One frame of a method.
struct Drawn {
    method: String,
    mask: Vec<u8>,
    /// Stencil counts; of a method that does not count, zeros.
    counts: Vec<u8>,
    error: MaskError,
}

/// One frame of each method.
fn draw_all<'a>(
    gpu: &Gpu,
    scene: &Scene,
    methods: impl IntoIterator<Item = &'a str>,
) -> Vec<Drawn> {
    let stage = FrameResources::new(gpu, scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let context = PrepareContext::new(gpu, scene, &stage);
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(gpu, scene, &stage, &cache).unwrap();
    let truth = verifier.truth(&scene.flight.at(0.0)).unwrap();
    let draw = |method: &str| {
        let mut prepared = Registry::builtin()
            .parse(method)
            .unwrap()
            .prepare(&context)
            .unwrap();
        let mask = verifier.draw_mask(prepared.as_mut(), &truth).unwrap();
        Drawn {
            method: method.to_owned(),
            counts: readback::read_stencil(gpu, &stage.targets.depth).unwrap(),
            error: verifier
                .compare(&mask, &truth, prepared.as_ref())
                .unwrap()
                .error,
            mask,
        }
    };
    methods.into_iter().map(draw).collect()
}

/// Mask and errors of one frame.
fn draw(gpu: &Gpu, scene: &Scene, method: &str) -> (Vec<u8>, MaskError) {
    let drawn = draw_all(gpu, scene, [method]).pop().unwrap();
    (drawn.mask, drawn.error)
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
fn edges_that_decide_by_themselves_leak_where_a_triangle_is_edge_on() {
    let gpu = device();
    let (leaning_box, light) = box_edge_on_to_the_light(9);
    let scene = scene_over_ground(&leaning_box, 0.0, light, &view());
    for method in ["silhouette_ts", "silhouette_gs"] {
        let wrong = |determinism: &str| {
            let (_, error) = draw(&gpu, &scene, &format!("{method},determinism={determinism}"));
            error
        };
        let none = wrong("none");
        assert!(none.artifact_px > 50, "{method}: {none:?}");
        assert_eq!(wrong("reference_edge").wrong_px(), 0, "{method}");
        assert_eq!(wrong("consistent_triangle").wrong_px(), 0, "{method}");
    }
}

#[test]
fn a_fan_of_any_number_of_pages_is_right() {
    let gpu = device();
    // Single pixels at the outline of a page are wrong in a frame in nine (METHODOLOGY.md, remaining errors);
    // a page too much or too few would be hundreds.
    let (mut frames, mut frames_with_artifacts) = (0, 0);
    let mut faults = Vec::new();
    // All that stages have room for without splitting, and some of the others.
    let few = (1..=70).chain((71..=300).step_by(11));
    for pages in few.chain([120, 255, 256, 257, 300]) {
        let scene = scene_over_ground(&fan(pages), 0.0, POINT_LIGHT, &view());
        // Splitting in every possible way costs most of the time, and few numbers suffice for it.
        let split: &[&str] = match pages {
            1 | 2 | 3 | 5 | 32 | 33 | 70 | 120 | 300 => &[
                "silhouette_ts,max_multiplicity=1",
                "silhouette_ts,max_multiplicity=7",
                "silhouette_gs,max_multiplicity=3",
                "silhouette_gs,max_multiplicity=64,input=storage",
                "silhouette_ts,input=storage,max_multiplicity=5",
                "silhouette_ts,determinism=consistent_triangle",
                "silhouette_gs,determinism=consistent_triangle,reach=infinity",
            ],
            _ => &[],
        };
        for drawn in draw_all(&gpu, &scene, volume_methods().chain(split.iter().copied())) {
            let Drawn { method, error, .. } = &drawn;
            assert!(drawn.mask.contains(&255), "{pages} pages cast a shadow");
            frames += 1;
            frames_with_artifacts += u32::from(error.artifact_px > 0);
            if error.artifact_px > 2 || error.wrong_px() > 15 {
                faults.push(format!("{method}, {pages} pages: {error:?}"));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(
        frames_with_artifacts * 6 < frames,
        "{frames_with_artifacts} of {frames}"
    );
}

/// Pixels whose counts differ.
fn differing(a: &[u8], b: &[u8]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

#[test]
fn all_volume_methods_count_alike() {
    let gpu = device();
    let plan = find_scene("sphere_grid", Path::new("")).unwrap();
    let file = plan.file.with_sphere_grid(Some(3), Some(4), Some(10));
    let spheres = file.unwrap().load(&plan.search).unwrap();
    let pages = scene_over_ground(&fan(9), 0.0, POINT_LIGHT, &view());
    for scene in [spheres, pages] {
        let variants = ["", ",counting=z_pass", ",counting=auto", ",reach=infinity"];
        let names: Vec<_> = volume_methods()
            .flat_map(|method| variants.map(|variant| format!("{method}{variant}")))
            .collect();
        let drawn = draw_all(&gpu, &scene, names.iter().map(String::as_str));
        let first = &drawn[0];
        let shadowed = first.counts.iter().filter(|count| **count > 0).count();
        assert!(shadowed > 1000, "{shadowed}");
        for other in &drawn {
            let most = other.counts.iter().max();
            assert!(
                most.is_some_and(|most| (1..100).contains(most)),
                "{}: counts up to {most:?}",
                other.method
            );
            // Single pixels, where rounding of another triangle order decides; triangle_ts pushes back.
            let differing = differing(&first.counts, &other.counts);
            let allowed = if other.method.starts_with("triangle_ts") {
                40
            } else {
                3
            };
            assert!(
                differing <= allowed,
                "{}: {differing} counts differ",
                other.method
            );
        }
    }
}

#[test]
fn z_pass_fails_where_the_eye_is_in_shadow_and_auto_does_not() {
    let gpu = device();
    let under_a_roof = View {
        eye: Vec3::new(0.3, 0.6, 0.4),
        target: Vec3::new(1.5, 0.0, 3.0),
        ..view()
    };
    let corner = |x: f32, z: f32| Vec3::new(x, 2.0, z);
    let (a, b, c, d) = (
        corner(-2., -2.),
        corner(-2., 2.),
        corner(2., -2.),
        corner(2., 2.),
    );
    let scene = scene_over_ground(&[[a, b, c], [c, b, d]], 0.0, POINT_LIGHT, &under_a_roof);
    for method in [
        "silhouette_ts",
        "silhouette_gs",
        "silhouette_cpu",
        "silhouette_cs",
        "silhouette_ms",
        "silhouette_vs",
        "triangle_ts",
        "triangle_gs",
        "adjacency_gs",
    ] {
        let artifacts = |counting: &str| {
            let (_, error) = draw(&gpu, &scene, &format!("{method},counting={counting}"));
            error.artifact_px
        };
        assert_eq!(artifacts("z_fail"), 0, "{method}");
        assert_eq!(artifacts("auto"), 0, "{method}");
        assert!(artifacts("z_pass") > 10_000, "{method}");
    }
}

#[test]
fn splitting_edges_is_counted() {
    let gpu = device();
    let scene = scene_over_ground(&fan(40), 0.0, POINT_LIGHT, &view());
    let stage = FrameResources::new(&gpu, &scene, 64, 64).unwrap();
    let context = PrepareContext::new(&gpu, &scene, &stage);
    let counters = |method: &str| {
        let prepared = Registry::builtin()
            .parse(method)
            .unwrap()
            .prepare(&context)
            .unwrap();
        prepared.counters()
    };
    let whole = counters("silhouette_gs,max_multiplicity=64,input=storage");
    assert_eq!(
        whole,
        [("edges", 81), ("edge_records", 81), ("extra_side_quads", 0)]
    );
    let split = counters("silhouette_ts,max_multiplicity=1");
    assert_eq!(split[1], ("edge_records", 80 + 40));
    assert!(split[2].1 > 0, "{split:?}");
    let patch = counters("silhouette_ts");
    assert_eq!(patch[1], ("edge_records", 80 + 2));
    assert!(patch[2].1 < split[2].1, "{patch:?} {split:?}");
    // The fan is dealt out in two halves.
    assert_eq!(patch[3], ("patch_vertices", 2 + 20));
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
    for method in volume_methods() {
        let mask = |triangles: &[[Vec3; 3]]| {
            draw(
                &gpu,
                &scene_over_ground(triangles, 0.0, POINT_LIGHT, &view()),
                method,
            )
            .0
        };
        let expected = mask(&right);
        let turned = differing(&expected, &mask(&turned));
        assert!(turned <= 2, "{method}: winding");
        assert!(
            differing(&expected, &mask(&doubled)) <= 2,
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
    for Drawn { method, error, .. } in draw_all(&gpu, &scene, volume_methods()) {
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
        for drawn in draw_all(&gpu, &scene, volume_methods()) {
            let Drawn {
                method,
                mask,
                error,
                ..
            } = drawn;
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
        ("silhouette_cpu", 1.0),
        ("silhouette_cs", 1.0),
        ("silhouette_ms", 1.0),
        ("silhouette_vs", 1.0),
        ("triangle_ts", 1.0),
        ("triangle_ts,passes=1", 1.0),
        ("triangle_gs", 1.0),
        ("adjacency_gs", 1.0),
        ("adjacency_gs,mode=robust,determinism=any_corner", 1.0),
        ("ray_query", 1.0),
        ("ray_compute", 1.0),
        ("ray_cpu", 1.0),
        ("alias_free_map", 1.0),
        ("alias_free_map,lists=sorted", 1.0),
        ("triangle_frusta", 1.0),
        ("shadow_map,resolution=4096", 2.0),
        ("cube_shadow_map,resolution=4096", 2.0),
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
    let maps = [
        "shadow_map,resolution=512",
        "cube_shadow_map,resolution=512",
    ];
    for method in volume_methods().chain(maps) {
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
    for map in ["shadow_map", "cube_shadow_map"] {
        let none = artifacts(&format!(
            "{map},resolution=256,constant_bias=0,slope_bias=0.0"
        ));
        let default = artifacts(&format!("{map},resolution=256"));
        assert!(
            none > 10 * default.max(5),
            "{map}: without bias {none}, by default {default}"
        );
    }
}

#[test]
fn a_cube_map_sees_all_around_its_light() {
    // A lamp in a ring of cards: each casts a shadow outwards, which one frustum cannot see all of.
    let gpu = device();
    let card = |i: u32| {
        let angle = 0.2 + std::f32::consts::TAU * i as f32 / 7.0;
        let at = |turn: f32, y: f32| {
            let angle = angle + turn;
            Vec3::new(2.0 * angle.cos(), y, 2.0 * angle.sin())
        };
        [at(-0.2, 0.1), at(0.2, 0.1), at(0.0, 0.9)]
    };
    let cards: Vec<_> = (0..7).map(card).collect();
    let view = View {
        eye: Vec3::new(0.3, 14.0, 3.0),
        ..view()
    };
    let scene = scene_over_ground(&cards, 0.0, Vec4::new(0.0, 0.6, 0.0, 1.0), &view);
    let wrong = |method: &str| draw(&gpu, &scene, method).1;
    let cube = wrong("cube_shadow_map,resolution=1024");
    assert!(cube.artifact_px <= 5 && cube.wrong_px() < 150, "{cube:?}");
    let single = wrong("shadow_map,resolution=2048");
    assert!(single.artifact_px > 100, "{single:?}");
}

#[test]
fn a_cube_map_needs_a_light_at_a_point() {
    let gpu = device();
    let light = Vec4::new(0.3, 1.0, 0.2, 0.0);
    let scene = scene_over_ground(&fan(3), 0.0, light, &view());
    let stage = FrameResources::new(&gpu, &scene, 8, 8).unwrap();
    let context = PrepareContext::new(&gpu, &scene, &stage);
    let refused = Registry::builtin()
        .parse("cube_shadow_map")
        .unwrap()
        .prepare(&context);
    let reason = refused.err().unwrap().to_string();
    assert!(reason.contains("light at a point"), "{reason}");
}
