//! Trees: a closed trunk, and leaves that are triangles without neighbours.

use super::shapes::polygon;
use crate::scene::part::Part;
use glam::{Vec2, Vec3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Sides of a trunk.
const SIDES: u32 = 6;
/// Triangles of a trunk: its sides, and fans at both ends.
const TRUNK_TRIANGLES: u32 = 2 * SIDES + 2 * (SIDES - 2);
/// Boughs of a crown, clouds of leaves: at least so many, of so many leaves at most.
const FEWEST_BOUGHS: u32 = 12;
const MOST_LEAVES: u32 = 300;

/// A tree of so many metres and triangles.
pub(super) fn tree(random: &mut ChaCha8Rng, foot: Vec2, height: f32, triangles: u32) -> Part {
    let trunk_top = 0.45 * height;
    let mut all = trunk(foot, 0.025 * height, trunk_top);
    let crown = Vec3::new(foot.x, 0.64 * height, foot.y);
    let size = Vec3::new(0.3, 0.36, 0.3) * height;
    let leaves = triangles.saturating_sub(TRUNK_TRIANGLES);
    // Leaves cover the crown a few times, however many there are.
    let leaf = (2.0 * height * height / leaves.max(1) as f32)
        .sqrt()
        .min(0.1 * height);
    let per_bough = (leaves / FEWEST_BOUGHS).clamp(1, MOST_LEAVES);
    let mut bough = crown;
    for number in 0..leaves {
        if number % per_bough == 0 {
            bough = crown + in_ball(random) * size * 0.7;
        }
        let middle = bough + in_ball(random) * size * 0.3;
        let corners = [0; 3].map(|_| middle + leaf * in_ball(random));
        all.push(corners);
    }
    Part::of_triangles("tree", &all)
}

fn trunk(foot: Vec2, radius: f32, top: f32) -> Vec<[Vec3; 3]> {
    let ring = |y: f32, radius: f32| {
        polygon(foot, radius, SIDES, 0.0)
            .into_iter()
            .map(move |p| Vec3::new(p.x, y, p.y))
            .collect::<Vec<_>>()
    };
    let (below, above) = (ring(-0.5, radius), ring(top, 0.6 * radius));
    let mut all = Vec::new();
    for side in 0..SIDES as usize {
        let next = (side + 1) % SIDES as usize;
        all.push([below[side], below[next], above[next]]);
        all.push([below[side], above[next], above[side]]);
    }
    for side in 1..SIDES as usize - 1 {
        all.push([above[0], above[side], above[side + 1]]);
        all.push([below[0], below[side + 1], below[side]]);
    }
    all
}

/// A point of the ball of radius 1 about the origin.
fn in_ball(random: &mut ChaCha8Rng) -> Vec3 {
    loop {
        let mut along = || random.random_range(-1.0..1.0f32);
        let point = Vec3::new(along(), along(), along());
        if point.length_squared() <= 1.0 {
            return point;
        }
    }
}
