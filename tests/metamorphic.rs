//! Scenes told otherwise, and the same shadow.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::device;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use svbench::config::find_scene;
use svbench::methods::{ShadowMethod, parameters::parse_method};
use svbench::scene::Scene;
use svbench::stress::{Studio, damage, metamorphic, random};

const SIZE_PX: (u32, u32) = (160, 120);
const METHODS: [&str; 5] = [
    "silhouette_ts",
    "silhouette_gs",
    "triangle_ts",
    "triangle_gs",
    "silhouette_gs,counting=auto",
];

fn methods(ids: &[&str]) -> Vec<Box<dyn ShadowMethod>> {
    ids.iter().map(|id| parse_method(id).unwrap()).collect()
}

/// Checks scenes with all methods, and fails if a mask changed that may not.
fn assert_unchanged(scenes: impl IntoIterator<Item = Scene>) {
    let gpu = device();
    let studio = Studio::new(&gpu, SIZE_PX);
    let methods = methods(&METHODS);
    let (mut rows, mut faults) = (0, Vec::new());
    for scene in scenes {
        let mut random = ChaCha8Rng::seed_from_u64(rows as u64);
        let differences = metamorphic::check(&studio, &scene, &methods, &mut random).unwrap();
        rows += differences.len();
        for difference in differences {
            let pixels = difference.pixels.as_ref().unwrap();
            if pixels.differing_px > 0 {
                println!("{}: {difference:?}", scene.name);
            }
            if difference.wrong_px() > 0 {
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
    assert_unchanged([grid, few_flaws, many_flaws]);
}

#[test]
fn sponza_keeps_its_shadow_however_it_is_told() {
    let plan = find_scene("sponza", Path::new("")).unwrap();
    match plan.file.load(&plan.search) {
        Ok(sponza) => {
            let flawed = damaged(&sponza, 0.02);
            assert_unchanged([sponza, flawed]);
        }
        Err(error) => println!("skipped: {error}"),
    }
}

#[test]
fn random_scenes_keep_their_shadow_however_they_are_told() {
    assert_unchanged((0..100).map(random::case));
}
