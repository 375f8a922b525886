//! Every robust method against the ray-traced truth, at the paper's picture size.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use crate::common::device;
use glam::Vec3;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use svbench::config::find_scene;
use svbench::frame::FrameResources;
use svbench::frame::PreparedMethod;
use svbench::gpu::Gpu;
use svbench::judge::Verifier;
use svbench::methods::{PrepareContext, Registry};
use svbench::metrics::MaskError;
use svbench::reference::ReferenceCache;
use svbench::scene::{Light, Moment, Scene, View};

const WIDTH: u32 = 1024;
const HEIGHT: u32 = 768;
/// 0.005 % of the picture.
const MAX_WRONG_PX: u64 = WIDTH as u64 * HEIGHT as u64 / 20_000;
/// 0.02 %: outlines of shadows and of dark sides pass some centres by less than the rasteriser's grid.
const MAX_AMBIGUOUS_PX: u64 = WIDTH as u64 * HEIGHT as u64 / 5_000;
/// Seeds of views and lights, and how many of each. With 3 and 11, volumes once had artifacts.
const SEEDS: [u64; 3] = [3, 4, 11];
const SHOTS: usize = 7;
const METHODS: [&str; 12] = [
    "silhouette_ts",
    "silhouette_gs",
    "silhouette_ts,determinism=consistent_triangle,counting=auto",
    "silhouette_gs,determinism=consistent_triangle,reach=infinity",
    "silhouette_ts,input=storage,counting=auto",
    "silhouette_gs,input=storage,counting=auto",
    "silhouette_cpu",
    "silhouette_cpu,counting=auto,extraction=hextree",
    "triangle_gs",
    "triangle_ts,counting=auto",
    "adjacency_gs,mode=robust",
    "adjacency_gs,mode=robust,determinism=any_corner,counting=auto",
];

/// Error of a picture, and how many of its wrong pixels are hard.
type Judged = (MaskError, usize);

/// Draws `scene` at each view and light with every other method, which others in turns, and returns their errors, a row a
/// view.
fn errors(gpu: &Gpu, scene: &Scene, shots: &[Moment]) -> Vec<Vec<Option<Judged>>> {
    let cache = ReferenceCache::open(None);
    let stage = FrameResources::new(gpu, scene, WIDTH, HEIGHT).unwrap();
    let mut methods: Vec<Box<dyn PreparedMethod>> = {
        let context = PrepareContext::new(gpu, scene, &stage);
        let prepare = |id| {
            Registry::builtin()
                .parse(id)
                .unwrap()
                .prepare(&context)
                .unwrap()
        };
        METHODS.map(prepare).into()
    };
    let verifier = Verifier::new(gpu, scene, &stage, &cache).unwrap();
    shots
        .iter()
        .enumerate()
        .map(|(shot, moment)| {
            let truth = verifier.truth(moment).unwrap();
            let judge = |method: &mut dyn PreparedMethod| {
                let mask = verifier.draw_mask(method, &truth).unwrap();
                let judgement = verifier.compare(&mask, &truth, method).unwrap();
                let hard = verifier.hard_errors(&mask, &truth).unwrap();
                (judgement.error, hard.len())
            };
            let methods = methods.iter_mut().enumerate();
            methods
                .map(|(number, method)| ((shot + number) % 2 == 0).then(|| judge(method.as_mut())))
                .collect()
        })
        .collect()
}

/// A point in a box.
fn point(random: &mut impl Rng, low: Vec3, high: Vec3) -> Vec3 {
    let mut coordinate = |low: f32, high: f32| random.random_range(low..high);
    Vec3::new(
        coordinate(low.x, high.x),
        coordinate(low.y, high.y),
        coordinate(low.z, high.z),
    )
}

/// A point in a box, outside of all spheres of the 10 × 10 grid.
fn outside_spheres(random: &mut impl Rng, low: Vec3, high: Vec3) -> Vec3 {
    loop {
        let p = point(random, low, high);
        let nearest = |x: f32| ((x + 11.25) / 2.5).round().clamp(0.0, 9.0) * 2.5 - 11.25;
        let centre = Vec3::new(nearest(p.x), 1.25, nearest(p.z));
        if p.distance(centre) > 1.05 {
            return p;
        }
    }
}

/// A view and a light at the 10 × 10 grid; of `path` the way in which it is seen.
pub(crate) fn random_shot(random: &mut impl Rng, path: View) -> Moment {
    let eye = outside_spheres(
        random,
        Vec3::new(-25.0, 0.3, -25.0),
        Vec3::new(25.0, 15.0, 25.0),
    );
    let target = point(
        random,
        Vec3::new(-10.0, 0.0, -10.0),
        Vec3::new(10.0, 2.0, 10.0),
    );
    let light = outside_spheres(
        random,
        Vec3::new(-15.0, 0.1, -15.0),
        Vec3::new(15.0, 30.0, 15.0),
    );
    Moment {
        view: View {
            eye,
            target,
            ..path
        },
        light: Light::at(light.extend(1.0)),
    }
}

fn sphere_grid_has_no_artifacts(slices: u32) {
    let plan = find_scene("sphere_grid", Path::new("")).unwrap();
    let file = plan
        .file
        .with_sphere_grid(None, None, Some(slices))
        .unwrap();
    let scene = file.load(&plan.search).unwrap();
    let path = scene.flight.at(0.0).view;
    let shots: Vec<_> = SEEDS
        .into_iter()
        .flat_map(|seed| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            (0..SHOTS)
                .map(|_| random_shot(&mut random, path))
                .collect::<Vec<_>>()
        })
        .collect();
    let device = device();
    let errors = errors(&device, &scene, &shots);
    let (mut faults, mut hard) = (Vec::new(), [0; METHODS.len()]);
    for (Moment { view, light }, row) in shots.iter().zip(&errors) {
        for ((method, judged), hard) in METHODS.iter().zip(row).zip(&mut hard) {
            let Some((error, hard_px)) = judged else {
                continue;
            };
            let place = format!(
                "{method}, n = {slices}, eye {}, target {}, light {}: {error:?}, {hard_px} hard",
                view.eye, view.target, light.place
            );
            println!("{place}");
            let few = error.wrong_px() < MAX_WRONG_PX && error.ambiguous_px < MAX_AMBIGUOUS_PX;
            // The tessellator has a say in triangle_ts (METHODOLOGY.md, remaining errors).
            let allowed = if method.starts_with("triangle_ts") {
                2
            } else {
                0
            };
            if error.artifact_px > allowed || !few {
                faults.push(place);
            }
            *hard += hard_px;
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
    println!(
        "hard errors in {} pictures: {hard:?} of {METHODS:?}",
        shots.len()
    );
    for (method, hard) in METHODS.iter().zip(hard) {
        let most = if method.starts_with("triangle_ts") {
            shots.len() / 4
        } else {
            1
        };
        assert!(hard <= most, "{method}: {hard} hard errors");
    }
}

#[test]
fn volumes_of_coarse_spheres_have_no_artifacts() {
    sphere_grid_has_no_artifacts(18);
}

#[test]
fn volumes_of_fine_spheres_have_no_artifacts() {
    sphere_grid_has_no_artifacts(60);
}
