//! Scenes for the tests of this module.

use crate::scene::{CameraKey, CameraPath, Flight, Light, Scene, SphereGrid};
use glam::{Vec3, Vec4};

/// Four coarse spheres over a ground that only receives.
pub(super) fn small_grid() -> Scene {
    let grid = SphereGrid {
        rows: 2,
        columns: 2,
        slices: 6,
        shells: 1,
    };
    let key = |time_s, x| CameraKey {
        time_s,
        eye: Vec3::new(x, 9.0, 20.0),
        target: Vec3::Y,
    };
    let camera = CameraPath {
        keys: vec![key(0.0, 3.0), key(2.0, 7.0)],
        up: Vec3::Y,
        fov_y_rad: 1.0,
        near: 0.1,
    };
    let mesh = grid.mesh().expect("a valid grid");
    let light = Vec4::new(3.0, 30.0, 5.0, 1.0);
    let flight = Flight::under(Light::at(light), camera);
    Scene::new("grid".to_owned(), "grid".to_owned(), mesh, flight)
}
