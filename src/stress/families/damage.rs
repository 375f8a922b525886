//! Meshes that are not what they should be: with holes, flipped, torn, through one another.

use super::shapes::{Shot, Triangle, flipped, in_cube, over_ground, part, random, sphere};
use glam::DVec3;
use rand::RngExt;
use rand::seq::SliceRandom;
use std::collections::HashSet;

/// Slices of the sphere that is damaged.
const SLICES: usize = 16;
/// Its triangles.
pub(super) const OPEN_MESH_TRIANGLES: u32 = (SLICES * SLICES) as u32;
/// As many as are sure to find an edge whose other triangle is whole.
pub(super) const MAX_T_JUNCTIONS: u32 = OPEN_MESH_TRIANGLES / 4;

fn whole_sphere() -> Vec<Triangle> {
    sphere(DVec3::new(0.0, 1.3, 0.0), 0.9, SLICES)
}

/// A sphere that lacks so many triangles.
pub(super) fn open_mesh(removed: usize, seed: u64) -> Shot {
    let mut triangles = whole_sphere();
    triangles.shuffle(&mut random(seed));
    over_ground([part("sphere", &triangles[removed..])])
}

/// A sphere with so large a part of its triangles flipped.
pub(super) fn flipped_share(share: f64, seed: u64) -> Shot {
    let mut triangles = whole_sphere();
    triangles.shuffle(&mut random(seed));
    let count = (share * triangles.len() as f64).round() as usize;
    for triangle in &mut triangles[..count] {
        *triangle = flipped(*triangle);
    }
    over_ground([part("sphere", &triangles)])
}

/// A sphere with so many edges that have a vertex in their middle on one side and none on the other. The
/// vertex is rounded, so it lies beside the edge by an ULP or so: there is a crack.
pub(super) fn t_junctions(count: usize, seed: u64) -> Shot {
    let mut triangles = whole_sphere();
    triangles.shuffle(&mut random(seed));
    let bits = |p: DVec3| p.to_array().map(f64::to_bits);
    let mut split = HashSet::new();
    let mut result = Vec::new();
    for [a, b, c] in triangles {
        // Where the other triangle at the edge is split as well, there would be no crack.
        if split.len() < count && !split.contains(&[bits(b), bits(a)]) {
            let middle = (a + b) / 2.0;
            result.extend([[a, middle, c], [middle, b, c]]);
            split.insert([bits(a), bits(b)]);
        } else {
            result.push([a, b, c]);
        }
    }
    over_ground([part("sphere", &result)])
}

/// So many spheres, each an object, all through one another.
pub(super) fn self_intersections(count: usize, seed: u64) -> Shot {
    let mut random = random(seed);
    let spheres = (0..count).map(|i| {
        let centre = DVec3::new(0.0, 1.3, 0.0) + in_cube(&mut random, 0.3);
        let sphere = sphere(centre, random.random_range(0.5..0.7), 10);
        part(&format!("sphere {i}"), &sphere)
    });
    over_ground(spheres.collect::<Vec<_>>())
}

/// So many triangles anywhere.
pub(super) fn random_soup(count: usize, seed: u64) -> Shot {
    let mut random = random(seed);
    let triangles: Vec<Triangle> = (0..count)
        .map(|_| {
            let centre = DVec3::new(0.0, 1.2, 0.0) + in_cube(&mut random, 0.4);
            [(); 3].map(|()| centre + in_cube(&mut random, 0.8))
        })
        .collect();
    over_ground([part("soup", &triangles)])
}
