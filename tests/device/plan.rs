//! No more than a scene needs: whatever of a volume is not drawn, the mask is that of all of it, z-fail to infinity.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests")]

use crate::common::{device, scene_over_ground, view};
use glam::{Vec3, Vec4};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use svbench::frame::FrameResources;
use svbench::gpu::Gpu;
use svbench::methods::{self, PrepareContext, Registry};
use svbench::scene::{
    CameraPath, Flight, Light, LightKey, LightKeys, Mesh, Moment, Part, Scene, SphereGrid, View,
};
use svbench::stress::random;

const SIZE_PX: (u32, u32) = (160, 120);

/// What draws all.
const FULL: &str = "silhouette_gs,reach=infinity";

/// Each switch alone, and all of them.
const PLANS: [&str; 20] = [
    "silhouette_gs,counting=auto",
    "silhouette_gs,counting=z_pass_counted",
    "silhouette_gs,reach=object",
    "silhouette_gs,culling=frustum",
    "silhouette_gs,casting=light_facing",
    "silhouette_gs,casting=each_side,counting=z_pass_counted",
    "silhouette_gs,edges=near_silhouette",
    "silhouette_gs,edges=near_silhouette,input=storage,casting=light_facing",
    "silhouette_cpu,counting=z_pass_counted",
    "silhouette_cpu,reach=object,culling=frustum",
    "silhouette_gs,plan=auto",
    "silhouette_ts,plan=auto",
    "silhouette_cpu,plan=auto",
    "silhouette_cs,plan=auto",
    "silhouette_cs,casting=each_side,counting=z_pass_counted",
    "silhouette_ms,plan=auto",
    "silhouette_vs,plan=auto",
    "triangle_gs,plan=auto",
    "adjacency_gs,plan=auto",
    "adjacency_gs,counting=auto,culling=frustum",
];

/// Those that leave out occluded triangles, where the light stands still.
const OF_STILL_LIGHTS: [&str; 10] = [
    "silhouette_gs,occluded=left_out",
    "silhouette_gs,plan=auto",
    "silhouette_ts,plan=auto",
    "silhouette_cpu,occluded=left_out",
    "silhouette_cpu,plan=auto",
    "silhouette_cs,plan=auto",
    "silhouette_ms,plan=auto",
    "silhouette_vs,plan=auto",
    "triangle_gs,occluded=left_out",
    "triangle_ts,plan=auto",
];

/// How many random views of each scene; more where somebody asks for them.
fn views() -> usize {
    let asked = std::env::var("SVBENCH_TEST_VIEWS");
    asked.map_or(12, |views| views.parse().unwrap())
}

fn point(random: &mut impl Rng, low: Vec3, high: Vec3) -> Vec3 {
    let mut between = |low: f32, high: f32| random.random_range(low..high);
    Vec3::new(
        between(low.x, high.x),
        between(low.y, high.y),
        between(low.z, high.z),
    )
}

/// Spheres of which `keep` says which triangles there are.
fn spheres(name: &str, keep: impl Fn(usize) -> bool) -> Scene {
    let grid = SphereGrid {
        rows: 3,
        columns: 3,
        slices: 10,
        shells: 1,
    };
    let all = grid.mesh().unwrap();
    let ground = all.objects.iter().position(|object| !object.casts_shadow);
    let is_ground = |triangle: usize| {
        ground.is_some_and(|ground| all.objects[ground].triangle_range().contains(&triangle))
    };
    let mesh = all.filtered(|triangle| is_ground(triangle) || keep(triangle));
    of_mesh(name, mesh)
}

fn of_mesh(name: &str, mesh: Mesh) -> Scene {
    // A light that moves: plans know nothing of it beforehand.
    let key = |time_s, place| LightKey { time_s, place };
    let light = LightKeys {
        keys: vec![key(0.0, Vec3::ZERO), key(1.0, Vec3::Y)],
        ..LightKeys::still(Light::at(Vec4::W))
    };
    let flight = Flight {
        camera: CameraPath::still(&view()),
        light: light.into(),
    };
    Scene::new(name.to_owned(), String::new(), mesh, flight)
}

/// A room around everything, with walls of many triangles, and boxes in it that have no bottom.
fn room() -> Scene {
    let mut parts = Vec::new();
    let wall = |origin: Vec3, u: Vec3, v: Vec3| {
        let at = |i: u32, j: u32| origin + u * (i as f32 / 6.0) + v * (j as f32 / 6.0);
        let cells = (0..36).map(|cell| (cell / 6, cell % 6));
        cells
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect::<Vec<_>>()
    };
    let (low, high) = (Vec3::new(-13.0, 0.0, -13.0), Vec3::new(13.0, 9.0, 13.0));
    let (x, y, z) = (Vec3::X * 26.0, Vec3::Y * 9.0, Vec3::Z * 26.0);
    for (name, origin, u, v) in [
        ("floor", low, z, x),
        ("back", low, x, y),
        ("left", low, y, z),
        ("right", high, -y, -z),
        ("front", high, -x, -y),
    ] {
        parts.push(Part::of_triangles(name, &wall(origin, u, v)));
    }
    for number in 0..8u32 {
        let corner = Vec3::new(
            (number % 4) as f32 * 6.0 - 11.0,
            0.4 + number as f32 * 0.31,
            (number / 4) as f32 * 9.0 - 8.0,
        );
        let (u, v, w) = (
            Vec3::new(2.3, 0.1, 0.4),
            Vec3::new(-0.2, 2.7, 0.1),
            Vec3::new(-0.3, 0.2, 2.1),
        );
        let sides = [
            wall(corner, v, u),
            wall(corner + w, u, v),
            wall(corner, w, v),
            wall(corner + u, v, w),
            wall(corner + v, w, u),
        ];
        parts.push(Part::of_triangles("box", &sides.concat()));
    }
    of_mesh("room", parts.into_iter().collect())
}

/// Spheres with triangles wound at random, some missing and some twice.
fn flipped() -> Scene {
    let mut random = ChaCha8Rng::seed_from_u64(41);
    let mesh = &spheres("", |_| true).mesh;
    let parts = mesh.objects.iter().map(|object| {
        let mut triangles = Vec::new();
        for triangle in object.triangle_range() {
            let [a, b, c] = mesh.corners(triangle);
            let triangle = if random.random_bool(0.3) {
                [a, c, b]
            } else {
                [a, b, c]
            };
            let copies = [0, 1, 1, 1, 1, 1, 1, 1, 1, 2][random.random_range(0..10usize)];
            triangles.extend(std::iter::repeat_n(triangle, copies));
        }
        Part::of_triangles("flipped", &triangles)
    });
    of_mesh("flipped", parts.collect())
}

fn scenes() -> Vec<Scene> {
    let mut two_sided: Vec<[Vec3; 3]> = Vec::new();
    for number in 0..12 {
        let at = Vec3::new(number as f32 - 6.0, 1.0 + 0.2 * number as f32, -2.0);
        let leaf = [
            at,
            at + Vec3::new(1.1, 0.4, 0.3),
            at + Vec3::new(0.2, 0.9, 1.2),
        ];
        two_sided.push(leaf);
        if number % 3 > 0 {
            two_sided.push([leaf[0], leaf[2], leaf[1]]);
        }
        if number % 3 > 1 {
            two_sided.push([leaf[0], leaf[2], leaf[1]]);
        }
    }
    let mut all = vec![
        spheres("spheres", |_| true),
        spheres("spheres with holes", |triangle| triangle % 37 > 2),
        spheres("scales", |triangle| triangle % 2 == 0),
        flipped(),
        room(),
        of_mesh(
            "leaves",
            scene_over_ground(&two_sided, 0.0, Vec4::W, &view())
                .mesh
                .as_ref()
                .clone(),
        ),
    ];
    let random = (0..6).map(random::case);
    all.extend(random.map(|case| of_mesh(&case.name, case.mesh.as_ref().clone())));
    all
}

/// Eye, near plane and light anywhere: in casters, in shadows, behind walls.
fn moment(random: &mut impl Rng) -> Moment {
    let low = Vec3::new(-12.5, 0.1, -12.5);
    let high = Vec3::new(12.5, 6.0, 12.5);
    let view = View {
        eye: point(random, low, high),
        target: point(random, low, high),
        up: Vec3::Y,
        fov_y_rad: random.random_range(0.5..1.9),
        near: 10f32.powf(random.random_range(-2.0..0.3)),
    };
    let light = if random.random_bool(0.25) {
        let direction = point(random, Vec3::new(-1.0, -0.3, -1.0), Vec3::ONE);
        Light::new(direction.as_dvec3(), 0.0).unwrap()
    } else {
        let at = point(random, low, Vec3::new(12.0, 14.0, 12.0));
        Light::new(at.as_dvec3(), 1.0).unwrap()
    };
    Moment { view, light }
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

/// Pixels of all views of a scene that a plan has otherwise away from boundaries, and views where these are many.
fn compare(
    gpu: &Gpu,
    scene: &Scene,
    plans: &[&'static str],
    moments: impl Iterator<Item = Moment>,
) -> Vec<(&'static str, usize, Vec<usize>)> {
    let stage = FrameResources::new(gpu, scene, SIZE_PX.0, SIZE_PX.1).unwrap();
    let context = PrepareContext::new(gpu, scene, &stage);
    let prepare = |method: &str| {
        let method = Registry::builtin().parse(method).unwrap();
        methods::prepare(method.as_ref(), &context).unwrap()
    };
    let mut full = prepare(FULL);
    let mut found: Vec<_> = plans.iter().map(|plan| (*plan, 0, Vec::new())).collect();
    let mut plans: Vec<_> = plans.iter().map(|plan| prepare(plan)).collect();
    for (number, moment) in moments.enumerate() {
        stage.set_view(gpu, &moment);
        let expected = stage.draw_mask(gpu, full.as_mut()).unwrap();
        for (method, (_, pixels, bad)) in plans.iter_mut().zip(&mut found) {
            let mask = stage.draw_mask(gpu, method.as_mut()).unwrap();
            let differing = (0..mask.len()).filter(|&i| mask[i] != expected[i]);
            let inside = differing.filter(|&i| !at_a_boundary(&expected, i)).count();
            *pixels += inside;
            if inside > 2 {
                bad.push(number);
            }
        }
    }
    found
}

/// What is too much of it.
fn faults(scene: &Scene, found: Vec<(&'static str, usize, Vec<usize>)>) -> Vec<String> {
    let told = |(plan, pixels, bad): (&'static str, usize, Vec<usize>)| {
        let told = format!("{}: {plan}: {pixels} pixels, {bad:?}", scene.name);
        if pixels > 0 {
            println!("{told}");
        }
        (!bad.is_empty() || pixels > 1 + views() / 50).then_some(told)
    };
    found.into_iter().filter_map(told).collect()
}

#[test]
fn no_plan_changes_the_mask() {
    let gpu = device();
    let mut random = ChaCha8Rng::seed_from_u64(14);
    let mut all = Vec::new();
    for scene in scenes() {
        let moments = (0..views()).map(|_| moment(&mut random));
        all.extend(faults(&scene, compare(&gpu, &scene, &PLANS, moments)));
    }
    assert!(all.is_empty(), "{all:#?}");
}

#[test]
fn what_a_light_that_stands_still_does_not_reach_need_not_cast() {
    let gpu = device();
    let mut random = ChaCha8Rng::seed_from_u64(1414);
    let mut all = Vec::new();
    for scene in scenes() {
        for _ in 0..views().div_ceil(4) {
            let scene = scene.clone().with_light(moment(&mut random).light);
            let moments = (0..4).map(|_| Moment {
                light: scene.flight.at(0.0).light,
                ..moment(&mut random)
            });
            let found = compare(&gpu, &scene, &OF_STILL_LIGHTS, moments);
            all.extend(faults(&scene, found));
        }
    }
    assert!(all.is_empty(), "{all:#?}");
}
