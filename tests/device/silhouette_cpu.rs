//! Silhouettes on the processor: however they are found, and whatever caps are made of, the mask is the same.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use std::sync::Arc;
use svbench::frame::FrameResources;
use svbench::gpu::Gpu;
use svbench::judge::Verifier;
use svbench::methods::{self, PrepareContext, Registry};
use svbench::metrics::MaskError;
use svbench::reference::ReferenceCache;
use svbench::scene::{Flight, LightKey, LightKeys, LightPath, Scene, View};
use svbench::stress::{find_cause, random};

const SIZE_PX: (u32, u32) = (320, 240);
const FOUND_OTHERWISE: [&str; 4] = [
    "extraction=brute_force",
    "extraction=hextree",
    "extraction=hextree,hextree_depth=0",
    "keep=true",
];
const DRAWN_OTHERWISE: [&str; 7] = [
    "casting=all",
    "caps=triangles",
    "caps=far_triangles",
    "caps=triangles,casting=all",
    "counting=auto",
    "reach=infinity",
    "reach=infinity,caps=far_triangles,counting=auto",
];

/// Mask and error of the frames of a scene's flight, drawn one after the other.
pub(crate) fn draw(
    gpu: &Gpu,
    scene: &Scene,
    method: &str,
    frames: usize,
) -> Vec<(Vec<u8>, MaskError)> {
    let method = Registry::builtin().parse(method).unwrap();
    let stage = FrameResources::new(gpu, scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let stage = stage.with_depth(gpu, method.depth_setup()).unwrap();
    let context = PrepareContext::new(gpu, scene, &stage);
    let cache = ReferenceCache::open(None);
    let verifier = Verifier::new(gpu, scene, &stage, &cache).unwrap();
    let mut prepared = methods::prepare(method.as_ref(), &context).unwrap();
    prepared.begin();
    let times = scene.flight.frame_times(frames).into_iter();
    times
        .map(|time_s| {
            let moment = scene.flight.at(time_s);
            let truth = verifier.truth(&moment).unwrap();
            stage.set_view(gpu, &moment);
            let mask = stage.draw_next_mask(gpu, prepared.as_mut()).unwrap();
            let judgement = verifier.compare(&mask, &truth, prepared.as_ref()).unwrap();
            (mask, judgement.error)
        })
        .collect()
}

pub(crate) fn scenes() -> Vec<Scene> {
    // Lights outside and inside of closed objects and of open ones, on a vertex, and everywhere at random.
    let causes = [
        ("light_in_mesh", 0.2),
        ("light_in_mesh", 0.8),
        ("light_in_lantern", 0.9),
        ("light_on_element", 1.0),
        ("eye_in_volume", 0.8),
        ("near_plane_cuts_caster", 1.5),
    ];
    let causes = causes.map(|(cause, value)| find_cause(cause).unwrap().scene(value, 0));
    causes
        .into_iter()
        .chain((0..12).map(random::case))
        .collect()
}

#[test]
fn however_a_silhouette_is_found_the_mask_is_the_same() {
    let gpu = device();
    for scene in scenes() {
        let [(expected, _)] = &draw(&gpu, &scene, "silhouette_cpu", 1)[..] else {
            panic!()
        };
        for variant in FOUND_OTHERWISE {
            let [(mask, _)] = &draw(&gpu, &scene, &format!("silhouette_cpu,{variant}"), 1)[..]
            else {
                panic!()
            };
            assert!(mask == expected, "{}: {variant}", scene.name);
        }
    }
}

#[test]
fn however_volumes_are_made_the_mask_is_right() {
    let gpu = device();
    for scene in scenes() {
        for variant in DRAWN_OTHERWISE {
            let [(_, error)] = &draw(&gpu, &scene, &format!("silhouette_cpu,{variant}"), 1)[..]
            else {
                panic!()
            };
            assert_eq!(error.artifact_px, 0, "{}: {variant}", scene.name);
        }
    }
}

/// A tetrahedron over the ground, and a light on its way through a face's plane, along it, through an edge and a vertex.
pub(crate) fn light_through_elements() -> Scene {
    let [a, b, c, d] = [
        Vec3::new(-1.0, 0.5, 0.75),
        Vec3::new(1.0, 0.5, 0.5),
        Vec3::new(0.0, 0.5, -1.0),
        Vec3::new(0.25, 1.75, 0.25),
    ];
    let faces = [[a, b, d], [b, c, d], [c, a, d], [b, a, c]];
    let eye = View {
        eye: Vec3::new(3.0, 4.0, 6.0),
        ..view()
    };
    let scene = scene_over_ground(&faces, 0.0, Vec4::Y, &eye);
    let places = [
        Vec3::new(2.0, 5.0, 1.0),
        // In the plane of a face, beside it.
        a + 2.0 * (d - a) + 0.5 * (b - a),
        0.5 * (a + d),
        d,
        d + (d - b),
        Vec3::new(-3.0, 4.0, 1.0),
    ];
    let key = |(i, place): (usize, Vec3)| LightKey {
        time_s: i as f64,
        place,
    };
    let light = LightPath::Keys(LightKeys {
        keys: places.into_iter().enumerate().map(key).collect(),
        w: 1.0,
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
fn a_light_may_pass_through_vertex_edge_and_face_plane() {
    let gpu = device();
    let scene = light_through_elements();
    for method in [
        "silhouette_cpu",
        "silhouette_cpu,counting=auto,keep=true",
        "silhouette_cpu,extraction=hextree,caps=triangles",
        "silhouette_cs",
        "silhouette_cs,extraction=facings,counting=auto",
        "silhouette_vs",
        "silhouette_ts",
        "silhouette_gs",
        "triangle_gs",
    ] {
        for (frame, (_, error)) in draw(&gpu, &scene, method, 11).iter().enumerate() {
            assert_eq!(error.artifact_px, 0, "{method}, frame {frame}");
        }
    }
}
