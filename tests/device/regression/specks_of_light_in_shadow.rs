//! Wrong pixels that no tie excuses: the truth is the same all around their centre.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use svbench::frame::FrameResources;
use svbench::judge::Verifier;
use svbench::methods::{PrepareContext, Registry};
use svbench::reference::{ReferenceCache, Verdict};
use svbench::scene::{Moment, Scene, SphereGrid, View};

/// Balls with a rough skin under a roof: as many outlines for the light as a scan has, all of them in shadow.
fn rough_balls_under_a_roof() -> Scene {
    let grid = SphereGrid {
        rows: 3,
        columns: 3,
        slices: 150,
        shells: 1,
    };
    let mesh = grid.mesh().unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let rough: Vec<Vec3> = mesh
        .positions
        .iter()
        .map(|p| *p * 0.3 + Vec3::from_array([(); 3].map(|()| random.random_range(-0.02..0.02))))
        .collect();
    let balls = mesh
        .casters()
        .flat_map(|ball| &mesh.triangles[ball.triangle_range()]);
    let mut triangles: Vec<[Vec3; 3]> = balls
        .map(|corners| corners.map(|corner| rough[corner as usize]))
        .collect();
    // A slab, which counts two like the balls: a side quad on the wrong side of its surface leaves none.
    let corner = |i: u32| {
        let at = |bit: u32, low: f32, high: f32| if i & bit == 0 { low } else { high };
        Vec3::new(at(1, -60.0, 60.0), at(2, 9.0, 9.5), at(4, -60.0, 60.0))
    };
    let faces = [
        [0, 1, 3, 2],
        [4, 6, 7, 5],
        [0, 4, 5, 1],
        [2, 3, 7, 6],
        [0, 2, 6, 4],
        [1, 5, 7, 3],
    ];
    for [a, b, c, d] in faces.map(|face| face.map(corner)) {
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let light = Vec4::new(4.0, 12.0, 3.0, 1.0);
    scene_over_ground(&triangles, -1.0, light, &view())
}

#[test]
fn no_specks_of_light_in_a_shadow() {
    let gpu = device();
    let scene = rough_balls_under_a_roof();
    let stage = FrameResources::new(&gpu, &scene, 1024, 768).unwrap();
    let context = PrepareContext::new(&gpu, &scene, &stage);
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(&gpu, &scene, &stage, &cache).unwrap();
    let eyes = [(2.2, 2.4, 2.6), (-2.0, 3.0, 2.9), (0.4, 4.5, -1.0)];
    let views = eyes.map(|(x, y, z)| View {
        eye: Vec3::new(x, y, z),
        ..view()
    });
    let light = scene.flight.at(0.0).light;
    let truths = views.map(|view| verifier.truth(&Moment { view, light }).unwrap());
    let undecided = truths
        .each_ref()
        .map(|truth| truth.mask.count(Verdict::Ambiguous));
    assert!(undecided.iter().all(|px| *px <= 10), "{undecided:?}");
    for method in [
        "silhouette_ts",
        "silhouette_gs",
        "triangle_ts",
        "triangle_gs",
    ] {
        let mut prepared = Registry::builtin()
            .parse(method)
            .unwrap()
            .prepare(&context)
            .unwrap();
        let hard = truths.each_ref().map(|truth| {
            let mask = verifier.draw_mask(prepared.as_mut(), truth).unwrap();
            verifier.hard_errors(&mask, truth).unwrap().len()
        });
        assert!(
            hard.iter().sum::<usize>() <= 2,
            "{method}: {hard:?} hard errors"
        );
    }
}
