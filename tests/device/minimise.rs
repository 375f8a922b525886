//! A few triangles that make a method fail, hidden among ten thousand: they are found, and what is written
//! fails again.
#![allow(clippy::unwrap_used, clippy::print_stderr, reason = "tests")]

use crate::common::{box_edge_on_to_the_light, device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use std::process::{Command, Output};
use std::time::Instant;
use svbench::gpu::Gpu;
use svbench::judge::Judge;
use svbench::judge::Observer;
use svbench::methods::Registry;
use svbench::scene::{ModelSearch, Scene, SceneFile, export};
use svbench::stress::minimise::minimise;

const SIZE_PX: (u32, u32) = (160, 120);
const HAY: usize = 10_000;
const MAX_LEFT: usize = 12;

struct Nobody;

impl Observer for Nobody {
    fn begin(&self, _: u64) {}
    fn phase(&self, text: &str) {
        eprintln!("{text}");
    }
    fn advance(&self, _: u64) {}
    fn interrupted(&self) -> bool {
        false
    }
}

fn vector(random: &mut impl Rng, half: f32) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| random.random_range(-half..half)))
}

/// Small triangles behind and below the eye of [`view`].
fn soup(seed: u64) -> Vec<[Vec3; 3]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let triangle = |_| {
        let centre = Vec3::new(10.0, 2.0, 16.0) + vector(&mut random, 1.9);
        [(); 3].map(|()| centre + vector(&mut random, 0.3))
    };
    (0..HAY).map(triangle).collect()
}

/// Minimises, writes, reads and draws again.
fn shrink(gpu: &Gpu, scene: &Scene, method: &str) {
    let judge = Judge::new(gpu, SIZE_PX);
    let methods = [Registry::builtin().parse(method).unwrap()];
    let artifact_px = |scene: &Scene| -> anyhow::Result<u64> {
        Ok(judge.trial(scene, &methods).attempts[0].artifact_px())
    };
    let started = Instant::now();
    let mut fails = |scene: &Scene| Ok(artifact_px(scene)? > 0);
    let minimised = minimise(scene, &mut fails, &Nobody).unwrap();
    eprintln!(
        "{method}: {} of {} triangles, {} vertices, {} trials, {:.1} s",
        minimised.scene.mesh.triangles.len(),
        scene.mesh.triangles.len(),
        minimised.scene.mesh.positions.len(),
        minimised.trials,
        started.elapsed().as_secs_f64()
    );
    assert!(minimised.finished);
    assert!(minimised.scene.mesh.triangles.len() <= MAX_LEFT);

    let folder = tempfile::tempdir().unwrap();
    let path = export::write(&minimised.scene, folder.path(), "left").unwrap();
    let search = ModelSearch::for_scene_file(&path);
    let read = SceneFile::read(&path).unwrap().load(&search).unwrap();
    assert_eq!(read.mesh_hash, minimised.scene.mesh_hash);
    assert!(artifact_px(&read).unwrap() > 0);
}

#[test]
fn what_hides_the_eye_from_the_light_is_found() {
    let gpu = device();
    let light = Vec4::new(1.0, 40.0, 2.0, 1.0);
    // Between the light and the eye, so that the eye is in a shadow volume.
    let middle = view().eye.lerp(light.truncate(), 0.25);
    let corner = |x: f32, z: f32| middle + Vec3::new(0.73 * x, 0.11 * x * z, 0.87 * z);
    let (a, b, c, d) = (
        corner(-1.0, -1.0),
        corner(-1.0, 1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
    );
    let mut triangles = soup(1);
    triangles.splice(7001..7001, [[a, b, c], [c, b, d]]);
    let scene = scene_over_ground(&triangles, 0.0, light, &view());
    shrink(&gpu, &scene, "silhouette_gs,counting=z_pass");
}

#[test]
fn an_edge_on_triangle_that_leaks_is_found() {
    let gpu = device();
    let (leaning_box, light) = box_edge_on_to_the_light(29);
    assert!(leaning_box.len() > HAY);
    let scene = scene_over_ground(&leaning_box, 0.0, light, &view());
    shrink(&gpu, &scene, "silhouette_gs,determinism=none");
}

/// A table between the light and the eye, over a ground.
const TABLE: &str = "o table\nv -3 4 -3\nv -3 4 3\nv 3 4 3\nv 3 4 -3\nf 1 2 3 4\n\
    o post\nv 1 0 -4\nv 1 2 -4\nv 2 2 -4\nf 5 6 7\n\
    o ground\nv -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 8 9 10 11\n";
const SCENE: &str = r#"title = "Table"
[mesh]
kind = "obj"
file = "table.obj"
up = "y"
receivers = ["ground"]
[light]
position = [0.3, 20.0, 0.2]
[camera]
fov_deg = 60.0
near = 0.1
keys = [{ time_s = 0.0, eye = [0.1, 2.0, 1.3], target = [0.0, 0.5, -5.0] }]
"#;

fn svbench(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_svbench"));
    let command = command.current_dir(folder).env("SVBENCH_CACHE", "");
    command.args(arguments).output().unwrap()
}

#[test]
fn the_command_writes_a_scene_that_render_draws_wrong_too() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("table.obj"), TABLE).unwrap();
    std::fs::write(folder.join("table.toml"), SCENE).unwrap();
    let of = |method| {
        [
            "minimise",
            "table.toml",
            "--method",
            method,
            "--out",
            "a folder",
        ]
    };

    let said = svbench(folder, &of("silhouette_gs,counting=z_pass"));
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    let errors = String::from_utf8_lossy(&said.stderr);
    assert!(said.status.success(), "{errors}");
    for part in [
        "of 5 triangles are left",
        "trials in",
        "wrong pixels: ",
        "kinds of error: ",
    ] {
        assert!(text.contains(part), "no `{part}` in: {text}");
    }
    let command = "svbench render 'a folder/table_minimal.toml' \
                   --method silhouette_gs,counting=z_pass --size 160x120 --error error.png";
    assert!(text.contains(command), "{text}");
    #[rustfmt::skip]
    let render = [
        "render", "a folder/table_minimal.toml", "--method", "silhouette_gs,counting=z_pass",
        "--size", "160x120", "--error", "error.png", "--json",
    ];
    let drawn = svbench(folder, &render);
    let counts: serde_json::Value = serde_json::from_slice(&drawn.stdout).unwrap();
    assert!(
        counts["errors"]["artifact_px"].as_u64().unwrap() > 0,
        "{counts}"
    );
    assert!(counts["triangles"].as_u64().unwrap() < 3, "{counts}");
    assert!(folder.join("error.png").is_file());
}

#[test]
fn a_scene_that_does_not_fail_is_an_error_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    std::fs::write(folder.join("table.obj"), TABLE).unwrap();
    std::fs::write(folder.join("table.toml"), SCENE).unwrap();
    for (method, parts) in [
        (
            "silhouette_gs",
            ["the scene does not fail", "try another --time"],
        ),
        (
            "shadow_map,slope_bias=search",
            ["method `shadow_map", "search"],
        ),
    ] {
        let said = svbench(
            folder,
            &["minimise", "table.toml", "--method", method, "--out", "out"],
        );
        let errors = String::from_utf8_lossy(&said.stderr);
        assert_eq!(said.status.code(), Some(1), "{errors}");
        assert!(parts.iter().all(|part| errors.contains(part)), "{errors}");
    }
    assert!(!folder.join("out").exists());
}
