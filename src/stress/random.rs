//! Random scenes, each made from one number: triangles of all sizes without any order, lights and eyes
//! anywhere, inside of things too.

use crate::scene::mesh::canonical;
use crate::scene::{CameraKey, CameraPath, Flight, Light, Mesh, Part, Scene, SphereGrid};
use glam::{Vec3, Vec4};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Most triangles of a random scene, without the ground that half of them have.
const MAX_TRIANGLES: f32 = 200.99;

/// The random scene of a seed: the same on every machine.
pub fn case(seed: u64) -> Scene {
    let random = &mut ChaCha8Rng::seed_from_u64(seed);
    let count = log_uniform(random, 1.0, MAX_TRIANGLES) as usize;
    let casters = match random.random_range(0..4) {
        0 => free(random, count, false),
        1 => free(random, count, true),
        2 => connected(random, count),
        _ => damaged_sphere(random),
    };
    let ground = random.random_bool(0.5).then(|| ground(random));
    let light = light(random);
    let camera = CameraPath {
        keys: vec![CameraKey {
            time_s: 0.0,
            eye: in_cube(random, 3.0),
            target: in_cube(random, 0.5),
        }],
        up: Vec3::Y,
        fov_y_rad: 1.0,
        near: log_uniform(random, 0.001, 0.2),
    };
    let mesh: Mesh = [casters].into_iter().chain(ground).collect();
    let title = format!("Random scene {seed}");
    let flight = Flight::under(Light::at(light), camera);
    Scene::new(format!("random_{seed}"), title, mesh, flight)
}

/// Triangles that have nothing to do with each other, around the origin; corners are at most `size` from a
/// point in the cube from -1 to 1.
pub fn soup(random: &mut impl Rng, count: usize, size: f32) -> Vec<[Vec3; 3]> {
    let mut triangle = || {
        let centre = in_cube(random, 1.0);
        [(); 3].map(|()| canonical(centre + in_cube(random, size)))
    };
    (0..count).map(|_| triangle()).collect()
}

/// A soup of triangles of one size. On a coarse grid, corners and whole edges coincide, planes hold
/// several triangles, and some have no area.
fn free(random: &mut impl Rng, count: usize, on_grid: bool) -> Part {
    let size = log_uniform(random, 0.05, 2.0);
    let mut triangles = soup(random, count, size);
    if on_grid {
        for corner in triangles.as_flattened_mut() {
            *corner = to_grid(*corner);
        }
    }
    Part::of_triangles("soup", &triangles)
}

/// Triangles between few points: edges with any number of triangles, of any winding.
fn connected(random: &mut impl Rng, count: usize) -> Part {
    let points = random.random_range(3..count.max(4) + 3);
    let positions: Vec<Vec3> = (0..points).map(|_| in_cube(random, 1.0)).collect();
    let mut triangle = || [(); 3].map(|()| random.random_range(0..points) as u32);
    let triangles = (0..count).map(|_| triangle()).collect();
    Part::new("connected", &positions, triangles)
}

/// A sphere from which up to nine times a triangle was taken, turned, doubled or pulled out of shape.
fn damaged_sphere(random: &mut impl Rng) -> Part {
    let slices = 2 * random.random_range(2..7u32);
    let grid = SphereGrid {
        rows: 1,
        columns: 1,
        slices,
        shells: 1,
    };
    let Ok(mesh) = grid.mesh() else {
        unreachable!("so few slices are valid")
    };
    let Some(sphere) = mesh.casters().next() else {
        unreachable!("a grid has spheres")
    };
    // The one sphere of a grid has a radius of 10 and stands on the ground.
    let to_origin = |p: &Vec3| *p * 0.08 - Vec3::Y;
    let mut positions: Vec<Vec3> = mesh.positions[sphere.vertex_range()]
        .iter()
        .map(to_origin)
        .collect();
    let own = |index: u32| index - sphere.vertices.start;
    let triangles = mesh.triangles[sphere.triangle_range()].iter();
    let mut triangles: Vec<[u32; 3]> = triangles.map(|triangle| triangle.map(own)).collect();
    for _ in 0..3 * random.random_range(0..4) {
        let at = random.random_range(0..triangles.len());
        match random.random_range(0..4) {
            0 => drop(triangles.swap_remove(at)),
            1 => triangles[at].swap(0, 1),
            2 => triangles.push(triangles[at]),
            _ => positions[triangles[at][0] as usize] += in_cube(random, 0.2),
        }
    }
    Part::new("damaged_sphere", &positions, triangles)
}

fn ground(random: &mut impl Rng) -> Part {
    let y = random.random_range(-1.5..1.0f32);
    let corners = [(-4.0, -4.0), (-4.0, 4.0), (4.0, -4.0), (4.0, 4.0)];
    let corners = corners.map(|(x, z)| Vec3::new(x, y, z));
    Part::new("ground", &corners, vec![[0, 1, 2], [2, 1, 3]])
}

/// Mostly among the triangles; one in ten at infinity, one far away, and one on the coarse grid.
fn light(random: &mut impl Rng) -> Vec4 {
    match random.random_range(0..10) {
        0 => in_cube(random, 1.0).extend(0.0),
        1 => {
            let direction = in_cube(random, 1.0).normalize();
            (direction * log_uniform(random, 3.0, 1000.0)).extend(1.0)
        }
        2 => to_grid(in_cube(random, 2.0)).extend(1.0),
        _ => in_cube(random, 2.0).extend(1.0),
    }
}

fn to_grid(p: Vec3) -> Vec3 {
    (p * 4.0).round() / 4.0
}

fn in_cube(random: &mut impl Rng, half: f32) -> Vec3 {
    Vec3::from_array([(); 3].map(|()| random.random_range(-half..half)))
}

fn log_uniform(random: &mut impl Rng, low: f32, high: f32) -> f32 {
    random.random_range(low.ln()..high.ln()).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_is_a_scene() {
        for seed in 0..300 {
            let scene = case(seed);
            assert_eq!(scene, case(seed));
            assert!((1..=203).contains(&scene.mesh.triangles.len()), "{seed}");
            assert!(scene.mesh.positions.iter().all(|p| p.is_finite()));
            scene.flight.camera.validate().unwrap();
        }
        assert_ne!(case(1).mesh_hash, case(2).mesh_hash);
    }
}
