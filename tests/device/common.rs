//! What all tests on a device share.

use glam::{Vec3, Vec4};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use svbench::gpu::{Gpu, GpuOptions, messages};
use svbench::scene::{CameraPath, Flight, Light, Part, Scene, View};

static DEVICE: LazyLock<Mutex<Gpu>> = LazyLock::new(|| {
    let adapter = std::env::var("SVBENCH_TEST_ADAPTER").ok();
    let options = GpuOptions {
        adapter,
        validation: true,
        ..GpuOptions::default()
    };
    Mutex::new(Gpu::open(&options).expect(
        "tests need a Vulkan device and the validation layers; scripts/test.sh installs them",
    ))
});

/// The device, for one test at a time; dropping it fails the test if the validation layers spoke.
pub(crate) struct Device(MutexGuard<'static, Gpu>);

/// Waits for the device.
pub(crate) fn device() -> Device {
    let guard = DEVICE.lock().unwrap_or_else(PoisonError::into_inner);
    messages::take_validation_messages();
    Device(guard)
}

impl std::ops::Deref for Device {
    type Target = Gpu;

    fn deref(&self) -> &Gpu {
        &self.0
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        self.0.wait_idle();
        let messages = messages::take_validation_messages();
        if !std::thread::panicking() {
            assert!(messages.is_empty(), "validation layers: {messages:#?}");
        }
    }
}

/// Down upon the ground around the origin.
pub(crate) fn view() -> View {
    View {
        eye: Vec3::new(5.0, 6.0, 9.0),
        target: Vec3::new(0.0, 0.5, 0.0),
        up: Vec3::Y,
        fov_y_rad: 50f32.to_radians(),
        near: 0.1,
    }
}

/// A scene made of triangles that all cast, in one object, over a ground that only receives.
pub(crate) fn scene_over_ground(
    triangles: &[[Vec3; 3]],
    ground_y: f32,
    light: Vec4,
    view: &View,
) -> Scene {
    let corner = |x: f32, z: f32| Vec3::new(40.0 * x, ground_y, 40.0 * z);
    let (a, b, c, d) = (
        corner(-1.0, -1.0),
        corner(-1.0, 1.0),
        corner(1.0, -1.0),
        corner(1.0, 1.0),
    );
    let ground = Part::of_triangles("ground", &[[a, b, c], [c, b, d]]).receiver();
    let mesh = [Part::of_triangles("casters", triangles), ground];
    Scene::new(
        "test".to_owned(),
        "test".to_owned(),
        mesh.into_iter().collect(),
        Flight::under(Light::at(light), CameraPath::still(view)),
    )
}

/// A leaning box of six faces of 2 × `side` × `side` triangles, with the light in the plane of one face as
/// nearly as single precision can say: which way that face's triangles face is all rounding.
pub(crate) fn box_edge_on_to_the_light(side: u32) -> (Vec<[Vec3; 3]>, Vec4) {
    let origin = Vec3::new(-1.3, 0.4, -0.7);
    let axes = [
        Vec3::new(2.1, 0.13, 0.9),
        Vec3::new(0.17, 1.9, 0.31),
        Vec3::new(-0.4, 0.05, 1.1),
    ];
    // Every point of the lattice is computed in one way, so that faces meet.
    let at = |p: [u32; 3]| {
        let step = |k: usize| axes[k] * (p[k] as f32 / side as f32);
        origin + step(0) + step(1) + step(2)
    };
    let mut triangles = Vec::new();
    for normal in 0..3 {
        let (u, v) = ((normal + 1) % 3, (normal + 2) % 3);
        for (i, j, end) in (0..side).flat_map(|i| (0..2 * side).map(move |j| (i, j / 2, j % 2))) {
            let corner = |di: u32, dj: u32| {
                let mut p = [0; 3];
                p[normal] = end * side;
                p[u] = i + di;
                p[v] = j + dj;
                at(p)
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let light = origin + axes[0] * 0.6 + axes[1] * 4.3;
    (triangles, light.extend(1.0))
}
