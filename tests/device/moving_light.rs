//! A light that moves: every moment has its own truth, and methods draw it.
use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use std::sync::Arc;
use svbench::frame::FrameResources;
use svbench::judge::Verifier;
use svbench::methods::{self, PrepareContext, Registry};
use svbench::metrics::MaskComparison;
use svbench::reference::{ReferenceCache, Verdict};
use svbench::scene::{Flight, LightKey, LightKeys, LightPath, Scene};

/// A square plate above the ground, and a light that passes over it in 4 seconds.
fn plate_under(w: f32) -> Scene {
    let corner = |x, z| Vec3::new(x, 1.0, z);
    let [a, b, c, d] = [
        corner(-0.5, -0.4),
        corner(-0.4, 0.5),
        corner(0.5, 0.4),
        corner(0.4, -0.5),
    ];
    let scene = scene_over_ground(&[[a, b, c], [a, c, d]], 0.0, Vec4::Y, &view());
    let key = |(time_s, place): (f64, [f32; 3])| LightKey {
        time_s,
        place: Vec3::from_array(place),
    };
    let light = LightPath::Keys(LightKeys {
        keys: [
            (0.0, [4.0, 6.0, 1.0]),
            (2.5, [0.3, 7.0, -2.0]),
            (4.0, [-5.0, 6.0, 0.5]),
        ]
        .map(key)
        .to_vec(),
        w,
        radius: 0.0,
    });
    let flight = Flight {
        light,
        ..scene.flight
    };
    let mesh = Arc::unwrap_or_clone(scene.mesh);
    Scene::new(scene.name, scene.title, mesh, flight)
}

#[test]
fn every_moment_is_drawn_and_judged_by_its_own_light() {
    let gpu = device();
    for w in [1.0, 0.0] {
        let scene = plate_under(w);
        let stage = FrameResources::new(&gpu, &scene, 320, 240).unwrap();
        let cache = ReferenceCache::open(None);
        let verifier = Verifier::new(&gpu, &scene, &stage, &cache).unwrap();
        let context = PrepareContext::new(&gpu, &scene, &stage);
        let methods = [
            "silhouette_gs",
            "triangle_gs,counting=auto",
            "silhouette_ts",
            "silhouette_cpu",
            "silhouette_cs",
            "silhouette_ms",
            "silhouette_vs",
            "silhouette_cpu,counting=auto,keep=true",
            "shadow_map,resolution=1024",
            "cube_shadow_map,resolution=1024",
        ];
        for id in methods {
            if id.starts_with("cube") && w == 0.0 {
                continue;
            }
            let is_map = id.contains("map");
            let method = Registry::builtin().parse(id).unwrap();
            let mut prepared = methods::prepare(method.as_ref(), &context).unwrap();
            let mut masks: Vec<Vec<u8>> = Vec::new();
            for time_s in scene.flight.frame_times(5) {
                let truth = verifier.truth(&scene.flight.at(time_s)).unwrap();
                let mask = verifier.draw_mask(prepared.as_mut(), &truth).unwrap();
                let judgement = verifier.compare(&mask, &truth, prepared.as_ref()).unwrap();
                let place = format!("{id}, w = {w}, {time_s} s");
                if is_map {
                    let wrong_px = judgement.error.wrong_px();
                    assert!(wrong_px < 40, "{place}: {wrong_px} wrong");
                } else {
                    assert_eq!(judgement.error.artifact_px, 0, "{place}");
                }
                // The truth has a shadow, and another moment's mask is not it.
                let shadowed = truth.mask.count(Verdict::Shadowed);
                assert!(shadowed > 100, "{place}: {shadowed}");
                for earlier in &masks {
                    let other = MaskComparison::new(earlier, &truth.mask, |_, _| false).unwrap();
                    assert!(other.error().wrong_px() > 100, "{place}: as before");
                }
                masks.push(mask);
            }
        }
    }
}
