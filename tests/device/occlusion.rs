//! What is hidden is left out of the picture's cost, never of the picture.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::device;
use glam::{Vec3, Vec4};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::path::Path;
use svbench::config::find_scene;
use svbench::frame::{DepthSetup, FrameResources, PreparedMethod, Visibility};
use svbench::gpu::{FrameTimer, Gpu, readback};
use svbench::judge::Verifier;
use svbench::methods::{PrepareContext, Registry};
use svbench::reference::{ReferenceCache, Verdict};
use svbench::scene::camera::CameraPath;
use svbench::scene::{City, Flight, Light, Moment, Scene, View};

const SIZE_PX: (u32, u32) = (160, 120);

/// Each with its own state, as those of a run.
const METHODS: [&str; 10] = [
    "silhouette_gs",
    "silhouette_gs,counting=z_pass_counted,casting=each_side,reach=object",
    "silhouette_cpu",
    "silhouette_cs",
    "silhouette_vs,counting=auto",
    "silhouette_ts,counting=auto",
    "silhouette_ms,counter=blend32",
    "triangle_gs,depth=standard",
    "adjacency_gs,counter=stencil_export",
    "adjacency_gs,mode=robust,reach=infinity",
];

/// Of these, those that draw many objects by one call.
const BY_MANY: [&str; 4] = [
    "silhouette_cpu",
    "silhouette_cs",
    "silhouette_vs,counting=auto",
    "silhouette_ms,counter=blend32",
];

/// Generated cities, or those that somebody asks for by name.
fn cities() -> Vec<Scene> {
    if let Ok(names) = std::env::var("SVBENCH_TEST_CITIES") {
        let load = |name: &str| {
            let plan = find_scene(name, Path::new("")).unwrap();
            plan.file.load(&plan.search).unwrap()
        };
        return names.split(',').map(load).collect();
    }
    [(40, 1, 0), (150, 2, 1), (400, 3, 0)]
        .map(|(objects, seed, ledges)| {
            let city = City {
                objects,
                seed,
                ledges,
                tree_triangles: 0,
            };
            let camera = CameraPath::framing(Vec3::ZERO, Vec3::ONE);
            let flight = Flight::under(Light::at(Vec4::new(0.4, 1.0, 0.3, 0.0)), camera);
            let name = format!("city of {objects}");
            Scene::new(name.clone(), name, city.mesh().unwrap(), flight)
        })
        .into()
}

/// A method with and without culling.
struct Pair {
    name: &'static str,
    culled: Box<dyn PreparedMethod>,
    whole: Box<dyn PreparedMethod>,
    resources: FrameResources,
    /// Views in which a pixel is wrong without culling alone.
    mended: usize,
}

fn pairs(gpu: &Gpu, scene: &Scene, culling: &str) -> Vec<Pair> {
    let first = FrameResources::new(gpu, scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let pair = |name| {
        let [culled, whole] = [culling, "none"].map(|culling| {
            let method = format!("{name},culling={culling}");
            Registry::builtin().parse(&method).unwrap()
        });
        let resources = first.with_depth(gpu, culled.depth_setup()).unwrap();
        let context = PrepareContext::new(gpu, scene, &resources);
        let [culled, whole] = [culled, whole].map(|method| method.prepare(&context).unwrap());
        Pair {
            name,
            culled,
            whole,
            resources,
            mended: 0,
        }
    };
    let methods = METHODS.iter().copied();
    let is_taken = |name: &&str| culling == "occlusion" || !BY_MANY.contains(name);
    methods.filter(is_taken).map(pair).collect()
}

impl Pair {
    /// Draws a moment both ways and compares; gives how many volumes were hidden. Where a hidden volume has faces that do not
    /// cancel, a pixel of the whole may be wrong; any other that differs is a fault.
    fn compare(&mut self, gpu: &Gpu, scene: &Scene, moment: &Moment, what: &str) -> u32 {
        self.resources.set_view(gpu, moment);
        let draw =
            |method: &mut dyn PreparedMethod| self.resources.draw_next_mask(gpu, method).unwrap();
        let (culled, whole) = (draw(self.culled.as_mut()), draw(self.whole.as_mut()));
        let differing: Vec<_> = (0..whole.len())
            .filter(|px| culled[*px] != whole[*px])
            .collect();
        if !differing.is_empty() {
            let cache = ReferenceCache::open(None);
            let verifier = Verifier::new(gpu, scene, &self.resources, &cache).unwrap();
            let truth = verifier.truth(moment).unwrap();
            let is_mended = |px: usize| match truth.mask.verdict(px) {
                Verdict::Lit => whole[px] == 255,
                Verdict::Shadowed => whole[px] == 0,
                Verdict::Ambiguous => true,
                Verdict::Background => false,
            };
            let mended = differing.iter().all(|px| is_mended(*px));
            assert!(
                mended && differing.len() <= 2,
                "{} {what}: {moment:?}",
                self.name
            );
            self.mended += 1;
        }
        self.culled.drawn_volumes().unwrap().hidden
    }
}

fn within(random: &mut impl Rng, low: Vec3, high: Vec3) -> Vec3 {
    let mut at = |low: f32, high: f32| random.random_range(low..=high);
    Vec3::new(at(low.x, high.x), at(low.y, high.y), at(low.z, high.z))
}

/// A view and a light anywhere in or above a city: in streets, in houses, over the roofs; the sun or a lamp.
fn anywhere(random: &mut impl Rng, scene: &Scene) -> Moment {
    let (low, high) = scene.mesh.caster_bounds();
    let size = high - low;
    let top = [0.1, 0.5, 2.0][random.random_range(0..3)];
    let above = low + size * Vec3::new(1.0, top, 1.0);
    let eye = within(random, low.max(Vec3::NEG_INFINITY.with_y(0.5)), above);
    let target = within(random, low, high);
    let light = match random.random_range(0..3) {
        0 => within(random, low, high + 2.0 * size.y * Vec3::Y).extend(1.0),
        _ => within(random, Vec3::new(-1.0, 0.1, -1.0), Vec3::ONE).extend(0.0),
    };
    let view = View {
        eye,
        target,
        up: Vec3::Y,
        fov_y_rad: random.random_range(0.4..1.8),
        near: random.random_range(0.05..1.0),
    };
    Moment {
        view,
        light: Light::at(light),
    }
}

/// A little on from a moment.
fn next(random: &mut impl Rng, moment: &Moment) -> Moment {
    let Moment { mut view, light } = *moment;
    let step = within(random, Vec3::splat(-1.0), Vec3::ONE);
    view.eye += step;
    view.target += step;
    let place = light.place + 0.01 * step.extend(0.0);
    Moment {
        view,
        light: Light::at(place),
    }
}

/// How many views of all cities together; more where somebody asks for them.
fn views() -> usize {
    let asked = std::env::var("SVBENCH_TEST_VIEWS");
    asked.map_or(500, |views| views.parse().unwrap())
}

fn masks_are_those_without(culling: &str) {
    let gpu = device();
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let cities = cities();
    let (mut hidden, mut mended) = (0, 0);
    for scene in &cities {
        let mut pairs = pairs(&gpu, scene, culling);
        let mut moment = anywhere(&mut random, scene);
        for view in 0..views().div_ceil(cities.len()) {
            // Three steps, and a jump of which nobody is told.
            moment = match view % 4 {
                0 => anywhere(&mut random, scene),
                _ => next(&mut random, &moment),
            };
            if moment.validate().is_err() {
                continue;
            }
            let what = format!("{}, view {view}", scene.name);
            // Others in turns, four frames each.
            let count = pairs.len();
            hidden += pairs[view / 4 % count].compare(&gpu, scene, &moment, &what);
        }
        mended += pairs.iter().map(|pair| pair.mended).sum::<usize>();
    }
    assert!(
        100 * mended <= views(),
        "{mended} views were wrong without culling"
    );
    // What the device leaves out, the processor does not know.
    let is_known = culling == "occlusion";
    assert!(!is_known || hidden > 1000, "{hidden} volumes were hidden");
}

#[test]
fn masks_with_occlusion_culling_are_those_without() {
    masks_are_those_without("occlusion");
}

#[test]
fn masks_with_culling_by_the_device_are_those_without() {
    masks_are_those_without("occlusion_gpu");
}

#[test]
fn methods_that_draw_many_objects_by_one_call_say_so() {
    let gpu = device();
    let scene = cities().swap_remove(0);
    let resources = FrameResources::new(&gpu, &scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let context = PrepareContext::new(&gpu, &scene, &resources);
    for name in BY_MANY {
        let method = format!("{name},culling=occlusion_gpu");
        let method = Registry::builtin().parse(&method).unwrap();
        let error = method.prepare(&context).err().unwrap().to_string();
        assert!(error.contains("use culling=occlusion"), "{error}");
    }
}

#[test]
fn nothing_flickers_on_a_flight_with_a_light_that_moves() {
    let gpu = device();
    let scene = cities().pop().unwrap();
    let culling = "occlusion";
    let mut pairs = pairs(&gpu, &scene, culling);
    for (number, pair) in pairs.iter_mut().take(2).enumerate() {
        let mut hidden = 0;
        let frames = [200, 60][number];
        for frame in 0..frames {
            let share = frame as f32 / frames as f32;
            let view = View {
                eye: Vec3::new(200.0 * share - 100.0, 1.7, 2.0),
                target: Vec3::new(200.0 * share + 100.0, 6.0, 80.0 * share),
                up: Vec3::Y,
                fov_y_rad: 1.0,
                near: 0.1,
            };
            let (sin, cos) = (3.0 * share).sin_cos();
            let sun = Vec4::new(cos, 0.3 + share, sin, 0.0);
            let lamp = Vec4::new(150.0 * cos, 60.0, 150.0 * sin, 1.0);
            let light = Light::at(if number == 0 { sun } else { lamp });
            hidden += pair.compare(&gpu, &scene, &Moment { view, light }, "flight");
        }
        assert!(hidden > 50 * frames, "{hidden} volumes were hidden");
    }
}

/// What is known from the frames before makes no difference but in what it costs.
#[test]
fn a_new_flight_begins_with_nothing_known() {
    let gpu = device();
    let scene = cities().pop().unwrap();
    let mut pair = pairs(&gpu, &scene, "occlusion").swap_remove(0);
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let moment = anywhere(&mut random, &scene);
    let queries = |pair: &Pair| pair.culled.drawn_volumes().unwrap().queries;
    pair.compare(&gpu, &scene, &moment, "first");
    let first = queries(&pair);
    for _ in 0..3 {
        pair.compare(&gpu, &scene, &moment, "again");
    }
    assert!(queries(&pair) < first, "what was seen is not asked about");
    pair.culled.begin();
    pair.compare(&gpu, &scene, &moment, "begun");
    assert_eq!(queries(&pair), first);
}

/// Triangle numbers of a moment, and how many draw calls the G-buffer took.
fn numbers(gpu: &Gpu, resources: &FrameResources, moment: &Moment) -> (Vec<u8>, u32) {
    resources.set_view(gpu, moment);
    let mut timer = FrameTimer::new(gpu);
    let frame = timer.frame(gpu, |mut frame| {
        resources.record_gbuffer(&mut frame)?;
        Ok(frame)
    });
    assert!(frame.unwrap().is_none());
    let draw_calls = timer.finish(gpu).unwrap()[0].draw_calls;
    let numbers = readback::read_texture(gpu, &resources.targets.triangle_ids).unwrap();
    (numbers, draw_calls)
}

#[test]
fn hidden_objects_are_not_drawn_and_not_missed() {
    let gpu = device();
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let (mut culled_calls, mut all_calls) = (0, 0);
    for scene in cities() {
        let all = FrameResources::new(&gpu, &scene, SIZE_PX.0, SIZE_PX.1).unwrap();
        let setup = DepthSetup {
            visibility: Visibility::Occlusion,
            ..DepthSetup::default()
        };
        let culled = all.with_depth(&gpu, setup).unwrap();
        let mut moment = anywhere(&mut random, &scene);
        for view in 0..views().div_ceil(6) {
            moment = match view % 8 {
                0 => anywhere(&mut random, &scene),
                _ => next(&mut random, &moment),
            };
            if moment.validate().is_err() {
                continue;
            }
            let (expected, calls) = numbers(&gpu, &all, &moment);
            all_calls += calls;
            let (found, calls) = numbers(&gpu, &culled, &moment);
            culled_calls += calls;
            let differing = found.chunks(4).zip(expected.chunks(4));
            let differing = differing.filter(|(a, b)| a != b).count();
            assert_eq!(differing, 0, "{}, view {view}: {moment:?}", scene.name);
        }
    }
    assert!(culled_calls < all_calls, "{culled_calls} of {all_calls}");
}
