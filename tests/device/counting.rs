//! z-pass where it is provably right, z-fail elsewhere, against z-fail everywhere.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use crate::common::device;
use glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use svbench::config::find_scene;
use svbench::frame::FrameResources;
use svbench::frame::PreparedMethod;
use svbench::gpu::FrameTimer;
use svbench::methods::{PrepareContext, Registry};
use svbench::scene::{Light, Moment, View};

const SIZE_PX: (u32, u32) = (320, 240);
const VIEWS: usize = 40;
const METHODS: [&str; 4] = [
    "silhouette_ts",
    "silhouette_gs",
    "triangle_gs",
    "silhouette_gs,reach=infinity",
];

/// Centres of the spheres of the 10 × 10 grid, all of radius 1.
fn centres() -> impl Iterator<Item = Vec3> {
    let at = |i: u32| i as f32 * 2.5 - 11.25;
    (0..100).map(move |i| Vec3::new(at(i % 10), 1.25, at(i / 10)))
}

/// Whether a sphere lies between the point and the light.
fn in_shadow(p: Vec3, light: Vec3) -> bool {
    let to_light = light - p;
    centres().any(|centre| {
        let along = ((centre - p).dot(to_light) / to_light.length_squared()).clamp(0.0, 1.0);
        centre.distance(p + to_light * along) < 1.0
    })
}

/// Whether the mask changes next to a pixel.
fn at_a_boundary(mask: &[u8], i: usize) -> bool {
    let (width, height) = (SIZE_PX.0 as i32, SIZE_PX.1 as i32);
    let (x, y) = (i as i32 % width, i as i32 / width);
    let neighbours = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (x + dx, y + dy)));
    neighbours
        .filter(|(x, y)| (0..width).contains(x) && (0..height).contains(y))
        .any(|(x, y)| mask[(y * width + x) as usize] != mask[i])
}

#[test]
fn auto_is_z_fail_with_fewer_draws() {
    let gpu = device();
    let plan = find_scene("sphere_grid", Path::new("")).unwrap();
    let scene = plan.file.load(&plan.search).unwrap();
    let light = scene.flight.at(0.0).light.place.truncate();
    let stage = FrameResources::new(&gpu, &scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let context = PrepareContext::new(&gpu, &scene, &stage);
    let prepare = |method: &str, counting: &str| -> Box<dyn PreparedMethod> {
        let method = Registry::builtin()
            .parse(&format!("{method},counting={counting}"))
            .unwrap();
        method.prepare(&context).unwrap()
    };
    let mut pairs = METHODS.map(|method| (prepare(method, "z_fail"), prepare(method, "auto")));
    let mask = |method: &mut dyn PreparedMethod| stage.draw_mask(&gpu, method).unwrap();
    let draw_calls = |method: &mut dyn PreparedMethod| {
        let mut timer = FrameTimer::new(&gpu);
        timer
            .frame(&gpu, |frame| stage.record(frame, method))
            .unwrap();
        timer.finish(&gpu).unwrap()[0].draw_calls
    };

    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut point = |low: Vec3, high: Vec3| {
        let mut between = |low: f32, high: f32| random.random_range(low..high);
        Vec3::new(
            between(low.x, high.x),
            between(low.y, high.y),
            between(low.z, high.z),
        )
    };
    let (mut shadowed_eyes, mut faults) = (0, Vec::new());
    for _ in 0..VIEWS {
        // Low among the spheres: the shadows of most of them are there.
        let eye = point(Vec3::new(-13.0, 0.15, -13.0), Vec3::new(13.0, 2.5, 13.0));
        let view = View {
            eye,
            target: point(Vec3::new(-12.0, 0.0, -12.0), Vec3::new(12.0, 3.0, 12.0)),
            ..scene.flight.at(0.0).view
        };
        shadowed_eyes += usize::from(in_shadow(eye, light));
        let light = Light::at(light.extend(1.0));
        stage.set_view(&gpu, &Moment { view, light });
        for (method, (z_fail, auto)) in METHODS.iter().zip(&mut pairs) {
            let (expected, found) = (mask(z_fail.as_mut()), mask(auto.as_mut()));
            let differing = (0..expected.len()).filter(|&i| expected[i] != found[i]);
            let inside = differing.filter(|&i| !at_a_boundary(&expected, i)).count();
            if inside > 0 {
                faults.push(format!("{method}, eye {eye}: {inside} pixels"));
            }
            let (all, fewer) = (draw_calls(z_fail.as_mut()), draw_calls(auto.as_mut()));
            assert!(fewer < all, "{method}: {fewer} draw calls of {all}");
        }
    }
    println!("{shadowed_eyes} of {VIEWS} eyes in shadow");
    assert!(shadowed_eyes > VIEWS / 8, "{shadowed_eyes}");
    assert!(faults.is_empty(), "{faults:#?}");
}
