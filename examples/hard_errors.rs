//! Counts *hard errors*: pixels that are wrong although the truth is the same all around their centre.
//!
//!   cargo run --release --example hard_errors -- SCENE [SEEDS] [METHOD...]
//!
//! SCENE is the name or path of a scene file, or an OBJ file; SEEDS a range such as 0..10, a view and a light
//! for each.
#![allow(clippy::print_stdout, reason = "what it finds is its result")]

use anyhow::Context;
use glam::Vec3;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use svbench::config::find_scene;
use svbench::frame::FrameResources;
use svbench::gpu::{Gpu, GpuOptions};
use svbench::judge::Verifier;
use svbench::methods::{PrepareContext, Registry};
use svbench::reference::{ReferenceCache, Verdict};
use svbench::scene::{Light, Moment, Scene, Up, View};

const SIZE: (u32, u32) = (1024, 768);
const METHODS: [&str; 4] = [
    "silhouette_ts",
    "silhouette_gs",
    "triangle_ts",
    "triangle_gs",
];

fn load(name: &str) -> anyhow::Result<Scene> {
    if name.ends_with(".obj") {
        return Ok(Scene::from_obj(Path::new(name), Up::Z)?);
    }
    let (name, slices) = match name.split_once(':') {
        Some((name, slices)) => (name, Some(slices.parse()?)),
        None => (name, None),
    };
    let plan = find_scene(name, Path::new(""))?;
    let file = match slices {
        Some(_) => plan
            .file
            .with_sphere_grid(None, None, slices)
            .map_err(anyhow::Error::msg)?,
        None => plan.file,
    };
    Ok(file.load(&plan.search)?)
}

fn point(random: &mut impl Rng, low: Vec3, high: Vec3) -> Vec3 {
    let mut at = |low: f32, high: f32| random.random_range(low..=high);
    Vec3::new(at(low.x, high.x), at(low.y, high.y), at(low.z, high.z))
}

fn shot(scene: &Scene, seed: u64) -> Moment {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let casters = scene
        .mesh
        .casters()
        .flat_map(|object| &scene.mesh.positions[object.vertex_range()]);
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for p in casters {
        low = low.min(*p);
        high = high.max(*p);
    }
    let (centre, size) = ((low + high) / 2.0, high - low);
    if scene.flight.duration_s() > 0.0 {
        // Along the flight, with a light that is moved a little.
        let time_s = random.random_range(0.0..scene.flight.duration_s());
        let Moment { view, light } = scene.flight.at(time_s);
        let place = light.place.truncate();
        let reach = 0.1 * size;
        let light = point(random, place - reach, place + reach);
        let light = Light::at(light.extend(1.0));
        return Moment { view, light };
    }
    let path = scene.flight.at(0.0).view;
    let eye = loop {
        let eye = point(
            random,
            centre - 1.2 * size * Vec3::new(1.0, 0.2, 1.0),
            centre + 1.2 * size,
        );
        let inside = (eye - centre).abs().cmple(0.55 * size).all();
        if !inside {
            break eye;
        }
    };
    let target = point(random, centre - 0.3 * size, centre + 0.3 * size);
    let side = Vec3::new(1.0, 0.0, 1.0) * size;
    let light = point(
        random,
        low - side + Vec3::Y * size * 0.7,
        high + side + Vec3::Y * size.max_element() * 1.5,
    );
    let view = View {
        eye,
        target,
        ..path
    };
    let light = Light::at(light.extend(1.0));
    Moment { view, light }
}

fn main() -> anyhow::Result<()> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let scene = load(args.first().context("which scene?")?)?;
    let seeds = args.get(1).map_or("0..10", String::as_str);
    let (first, last) = seeds.split_once("..").context("SEEDS is a range")?;
    let (first, last): (u64, u64) = (first.parse()?, last.parse()?);
    let mut methods: Vec<String> = args.iter().skip(2).cloned().collect();
    if methods.is_empty() {
        methods = METHODS.map(str::to_owned).into();
    }
    let gpu = Gpu::open(&GpuOptions::default())?;
    let stage = FrameResources::new(&gpu, &scene, SIZE.0, SIZE.1)?;
    let context = PrepareContext::new(&gpu, &scene, &stage);
    let mut prepared: Vec<_> = methods
        .iter()
        .map(|method| Ok(Registry::builtin().parse(method)?.prepare(&context)?))
        .collect::<anyhow::Result<_>>()?;
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(&gpu, &scene, &stage, &cache)?;
    let mut sums = vec![[0u64; 6]; methods.len()];
    for seed in first..last {
        let moment = shot(&scene, seed);
        let truth = verifier.truth(&moment)?;
        for ((method, prepared), sums) in methods.iter().zip(&mut prepared).zip(&mut sums) {
            let mask = verifier.draw_mask(prepared.as_mut(), &truth)?;
            let error = verifier.compare(&mask, &truth, prepared.as_ref())?.error;
            let hard = verifier.hard_errors(&mask, &truth)?;
            let hidden = hard
                .iter()
                .filter(|px| truth.mask.verdict(**px) == Verdict::Ambiguous);
            let false_lit = hard.iter().filter(|px| mask[**px] == 0).count() as u64;
            let row = [
                hard.len() as u64,
                false_lit,
                hidden.count() as u64,
                error.artifact_px,
                error.boundary_px,
                error.ambiguous_px,
            ];
            println!(
                "{} {seed} {method}: hard {} ({} false lit, {} hidden), artifacts {}, boundary {}, ambiguous {}",
                scene.name, row[0], row[1], row[2], row[3], row[4], row[5]
            );
            sums.iter_mut().zip(row).for_each(|(sum, n)| *sum += n);
        }
    }
    for (method, row) in methods.iter().zip(&sums) {
        let frames = (last - first) as f64;
        let a = row.map(|n| n as f64 / frames);
        println!(
            "SUM {} {method}: hard {:.2} (lit {:.2}, hidden {:.2}), artifacts {:.2}, boundary {:.2}, ambiguous {:.1}",
            scene.name, a[0], a[1], a[2], a[3], a[4], a[5]
        );
    }
    Ok(())
}
