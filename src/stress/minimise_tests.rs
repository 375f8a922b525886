use std::cell::Cell;

use glam::Vec4;

use super::*;
use crate::scene::{CameraPath, Light, Mesh, Part};

/// Stops the search after so many looks at it.
struct After(Cell<usize>);

impl Observer for After {
    fn begin(&self, _: u64) {}
    fn phase(&self, _: &str) {}
    fn advance(&self, _: u64) {}
    fn interrupted(&self) -> bool {
        let left = self.0.get();
        self.0.set(left.saturating_sub(1));
        left == 0
    }
}

fn never() -> After {
    After(Cell::new(usize::MAX))
}

/// Triangles that each lie at a height of their own, in objects of 100; every other object receives.
fn tower(count: usize) -> Scene {
    let triangle = |i: usize| {
        let y = i as f32 + 0.123_4;
        [
            Vec3::new(0.0, y, 0.0),
            Vec3::new(1.3, y, 0.0),
            Vec3::new(0.0, y, 1.7),
        ]
    };
    let triangles: Vec<_> = (0..count).map(triangle).collect();
    let parts = triangles.chunks(100).enumerate().map(|(i, chunk)| {
        let part = Part::of_triangles("floor", chunk);
        if i % 2 == 0 { part } else { part.receiver() }
    });
    let mesh: Mesh = parts.collect();
    let (low, high) = mesh.bounds();
    let light = Vec4::new(0.37, 2000.1, 0.21, 1.0);
    let camera = CameraPath::framing(low, high);
    let flight = Flight::under(Light::at(light), camera);
    Scene::new("tower".to_owned(), "Tower".to_owned(), mesh, flight)
}

/// Heights of the triangles, rounded down.
fn floors(scene: &Scene) -> HashSet<usize> {
    let floor = |i| scene.mesh.corners(i)[0].y as usize;
    (0..scene.mesh.triangles.len()).map(floor).collect()
}

/// What is left where all these floors are needed, and how often was asked.
fn needing(needed: &[usize], count: usize) -> (Scene, usize) {
    let mut asks = 0;
    let mut fails = |scene: &Scene| {
        asks += 1;
        let floors = floors(scene);
        Ok(needed.iter().all(|floor| floors.contains(floor)))
    };
    let minimised = minimise(&tower(count), &mut fails, &never()).unwrap();
    assert!(minimised.finished);
    assert_eq!(minimised.trials, asks);
    (minimised.scene, asks)
}

#[test]
fn exactly_the_triangles_that_matter_are_left() {
    for needed in [&[7][..], &[0, 999], &[499, 500], &[3, 150, 420, 421, 998]] {
        let (scene, asks) = needing(needed, 1000);
        assert_eq!(floors(&scene), needed.iter().copied().collect());
        assert_eq!(scene.mesh.triangles.len(), needed.len());
        // Each that matters splits what it lies in some ten times; then its numbers are rounded.
        let most = needed.len() * (4 * 10 + 3 * 3 * 12) + 100;
        assert!(asks < most, "{asks} asks for {needed:?}");
    }
}

#[test]
fn large_scenes_take_few_questions() {
    let (scene, asks) = needing(&[17, 5000, 9999], 10_000);
    assert_eq!(scene.mesh.triangles.len(), 3);
    assert!(asks < 450, "{asks}");
    let receivers: Vec<_> = scene.mesh.objects.iter().map(|o| !o.casts_shadow).collect();
    assert_eq!(receivers, [false, false, true]);
}

#[test]
fn numbers_become_round_where_that_does_not_matter() {
    let (scene, _) = needing(&[7], 20);
    let ys = scene.mesh.positions.iter().map(|p| p.y);
    // The height is asked for of the first corner only.
    assert_eq!(ys.clone().fold(0.0, f32::max), 7.0);
    assert!(
        scene
            .mesh
            .positions
            .iter()
            .all(|p| [p.x, p.z] == [0.0, 0.0])
    );
    assert_eq!(scene.flight.at(0.0).light.place.truncate(), Vec3::ZERO);
    // The camera has to stay one.
    assert_eq!(scene.flight.camera.validate(), Ok(()));
    let key = scene.flight.camera.keys[0];
    let numbers = [key.eye, key.target].map(|v| v.to_array());
    assert!(
        numbers.as_flattened().iter().all(|x| effort(*x) < 2),
        "{key:?}"
    );
}

#[test]
fn a_direction_to_the_light_stays_one() {
    let scene = tower(3).with_light(Light::at(Vec4::new(0.123, 0.456, 0.789, 0.0)));
    let left = minimise(&scene, &mut |_| Ok(true), &never()).unwrap().scene;
    assert_eq!(
        (
            left.flight.at(0.0).light.place.w,
            left.flight.at(0.0).light.place.truncate().length_squared()
        ),
        (0.0, 1.0)
    );
    assert_eq!(left.mesh.triangles.len(), 1);
}

#[test]
fn what_does_not_fail_is_an_error_and_errors_come_out() {
    let error = minimise(&tower(10), &mut |_| Ok(false), &never()).unwrap_err();
    assert_eq!(error.to_string(), "the scene does not fail");
    let mut asks = 0;
    let mut breaks = |_: &Scene| {
        asks += 1;
        anyhow::ensure!(asks < 5, "lost");
        Ok(true)
    };
    let error = minimise(&tower(1000), &mut breaks, &never()).unwrap_err();
    assert_eq!(error.to_string(), "lost");
}

#[test]
fn a_search_that_is_stopped_keeps_what_it_has() {
    let mut fails = |scene: &Scene| Ok(floors(scene).contains(&700));
    let minimised = minimise(&tower(1000), &mut fails, &After(Cell::new(6))).unwrap();
    assert!(!minimised.finished);
    assert_eq!(minimised.trials, 7);
    let left = minimised.scene.mesh.triangles.len();
    assert!(
        left > 1 && left < 500 && floors(&minimised.scene).contains(&700),
        "{left}"
    );
}

#[test]
fn a_mesh_without_triangles_is_no_trouble() {
    let left = minimise(&tower(0), &mut |_| Ok(true), &never());
    assert_eq!(left.unwrap().scene.mesh.triangles.len(), 0);
}

#[test]
fn a_last_vertex_that_falls_on_another_ends_its_turn() {
    let triangle = [
        Vec3::new(0.0, 0.3, 0.0),
        Vec3::new(0.0, 0.3, 1.7),
        Vec3::new(1.3, 0.3, 0.0),
    ];
    let mesh: Mesh = [Part::of_triangles("one", &[triangle])]
        .into_iter()
        .collect();
    let (low, high) = mesh.bounds();
    let camera = CameraPath::framing(low, high);
    let light = Vec4::new(0.37, 20.1, 0.21, 1.0);
    let flight = Flight::under(Light::at(light), camera);
    let scene = Scene::new("one".to_owned(), "One".to_owned(), mesh, flight);
    let minimal = minimise(&scene, &mut |_| Ok(true), &never()).unwrap();
    assert_eq!(minimal.scene.mesh.triangles.len(), 1);
}
