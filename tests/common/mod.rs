//! What all tests on a device share.
#![allow(dead_code, reason = "each test program uses its own part")]

use glam::{Vec3, Vec4};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};
use svbench::gpu::{Gpu, GpuOptions, messages};
use svbench::scene::{CameraKey, CameraPath, Part, Scene, View};

static DEVICE: LazyLock<Mutex<Gpu>> = LazyLock::new(|| {
    let adapter = std::env::var("SVBENCH_TEST_ADAPTER").ok();
    let options = GpuOptions {
        adapter,
        validation: true,
    };
    Mutex::new(
        Gpu::open(&options).expect("tests need a Vulkan device; scripts/test.sh installs one"),
    )
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
    let camera = CameraPath {
        keys: vec![CameraKey {
            time_s: 0.0,
            eye: view.eye,
            target: view.target,
        }],
        up: view.up,
        fov_y_rad: view.fov_y_rad,
        near: view.near,
    };
    Scene::new(
        "test".to_owned(),
        "test".to_owned(),
        mesh.into_iter().collect(),
        light,
        camera,
    )
}
