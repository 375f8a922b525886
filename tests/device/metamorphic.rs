//! Scenes told otherwise, and the same shadow.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use svbench::config::find_scene;
use svbench::judge::Judge;
use svbench::methods::{Registry, ShadowMethod};
use svbench::scene::Scene;
use svbench::stress::metamorphic::Original;
use svbench::stress::{Change, Changed, damage, metamorphic, random};

const SIZE_PX: (u32, u32) = (160, 120);
const METHODS: [&str; 10] = [
    "silhouette_ts",
    "silhouette_gs",
    "triangle_ts",
    "triangle_gs",
    "adjacency_gs,mode=robust",
    "silhouette_gs,counting=auto",
    "silhouette_cpu",
    "ray_cpu",
    "alias_free_map",
    "triangle_frusta",
];

fn methods(ids: &[&str]) -> Vec<Box<dyn ShadowMethod>> {
    ids.iter()
        .map(|id| Registry::builtin().parse(id).unwrap())
        .collect()
}

/// Checks scenes with all methods, and fails if a mask changed that may not.
fn assert_unchanged(scenes: impl IntoIterator<Item = Scene>, methods: &[Box<dyn ShadowMethod>]) {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    let (mut rows, mut faults) = (0, Vec::new());
    for scene in scenes {
        let mut random = ChaCha8Rng::seed_from_u64(rows as u64);
        let differences = metamorphic::check(&judge, &scene, methods, &mut random).unwrap();
        rows += differences.len();
        for difference in differences {
            let pixels = difference.pixels.as_ref().unwrap();
            if pixels.differing_px > 0 {
                println!("{}: {difference:?}", scene.name);
            }
            // No tessellator has a say in how these cut and order the copies of a side quad.
            let exact = matches!(
                difference.change,
                Change::SplitObjects | Change::MergeObjects
            ) && !difference.method.starts_with("silhouette_ts");
            if difference.wrong_px() > 0 || exact && pixels.decided_px > 0 {
                faults.push(format!("{}: {difference:?}", scene.name));
            }
        }
    }
    println!("{rows} rows");
    assert!(faults.is_empty(), "{faults:#?}");
}

fn sphere_grid() -> Scene {
    let plan = find_scene("sphere_grid", Path::new("")).unwrap();
    let file = plan.file.with_sphere_grid(Some(5), Some(5), Some(18));
    file.unwrap().load(&plan.search).unwrap()
}

fn damaged(scene: &Scene, share: f64) -> Scene {
    damage(scene, share, &mut ChaCha8Rng::seed_from_u64(5))
}

#[test]
fn a_sphere_grid_keeps_its_shadow_however_it_is_told() {
    let grid = sphere_grid();
    let few_flaws = damaged(&grid, 0.02);
    let many_flaws = damaged(&grid, 0.5);
    assert_unchanged([grid, few_flaws, many_flaws], &methods(&METHODS));
}

#[test]
fn sponza_keeps_its_shadow_however_it_is_told() {
    let plan = find_scene("sponza", Path::new("")).unwrap();
    match plan.file.load(&plan.search) {
        Ok(sponza) => {
            // It has all that the model has, and flaws: a model without takes as long and says less.
            // Those that others are made of, and the way to find silhouettes that is not a shader's.
            let few = ["silhouette_ts", "triangle_gs", "silhouette_cpu"];
            assert_unchanged([damaged(&sponza, 0.02)], &methods(&few));
        }
        Err(error) => println!("skipped: {error}"),
    }
}

#[test]
fn random_scenes_keep_their_shadow_however_they_are_told() {
    assert_unchanged((0..20).map(random::case), &methods(&METHODS));
}

/// A leaning sheet with the light in its plane as nearly as single precision can say.
fn edge_on_sheet() -> Scene {
    const SIDE: u32 = 9;
    let (u, v) = (Vec3::new(2.1, 0.13, 0.9), Vec3::new(0.17, 1.9, 0.31));
    let origin = Vec3::new(-1.3, 0.4, -0.7);
    let at = |i: u32, j: u32| origin + u * (i as f32 / SIDE as f32) + v * (j as f32 / SIDE as f32);
    let cells = (0..SIDE * SIDE).map(|cell| (cell % SIDE, cell / SIDE));
    let triangles: Vec<_> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let light = origin + u * 0.6 + v * 4.3;
    scene_over_ground(&triangles, 0.0, light.extend(1.0), &view())
}

#[test]
fn edges_that_decide_by_themselves_are_caught() {
    let gpu = device();
    let judge = Judge::new(&gpu, (640, 480));
    let scene = edge_on_sheet();
    let wrong_px = |method: &str, change: Change| {
        let methods = methods(&[method]);
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let rows = metamorphic::check(&judge, &scene, &methods, &mut random).unwrap();
        let row = rows.iter().find(|row| row.change == change).unwrap();
        println!("{row:?}");
        row.wrong_px()
    };
    // Pushed back: the volumes of this sheet lie in its own plane, to the last bit of depth, and the order of
    // its vertices would show.
    let robust = "silhouette_gs,push_back_px=0.00390625";
    let none = format!("{robust},determinism=none");
    assert_eq!(wrong_px(&none, Change::Again), 0);
    assert!(wrong_px(&none, Change::RotateVertices) > 0);
    assert_eq!(wrong_px(robust, Change::RotateVertices), 0);
}

#[test]
fn a_change_of_the_shadow_is_caught() {
    let gpu = device();
    let judge = Judge::new(&gpu, SIZE_PX);
    let at = |x: f32| {
        let corners = [(-1.0, -1.0), (0.2, 1.3), (1.1, -0.4)];
        let triangle = corners.map(|(dx, z)| Vec3::new(x + dx, 1.0, z));
        scene_over_ground(&[triangle], 0.0, Vec4::new(1.0, 9.0, 2.0, 1.0), &view())
    };
    let (scene, methods) = (at(0.0), methods(&METHODS));
    let changed = Changed {
        scene: at(0.7),
        origins: (0..scene.mesh.triangles.len() as u32).collect(),
    };
    let original = Original::draw(&judge, &scene, &methods);
    for pixels in original.compare(&changed).unwrap() {
        let pixels = pixels.unwrap();
        println!("{pixels:?}");
        assert!(pixels.decided_px > 100, "{pixels:?}");
    }
}
