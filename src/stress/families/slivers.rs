//! Triangles that are hardly there: thin, without area, edge-on to the light.

use super::shapes::{Shot, Triangle, ground, over_ground, part, random, sphere, tilt};
use crate::scene::Part;
use glam::{DVec3, Vec3};
use rand::seq::SliceRandom;
use rand::{Rng, RngExt};
use std::collections::HashSet;
use std::f64::consts::TAU;

/// A closed prism whose sides are by turns wide and 10^`exponent` times as thin.
pub(super) fn needles(exponent: f64) -> Shot {
    const PAIRS: usize = 10;
    let thin = 10f64.powf(-exponent);
    let wide_angle = TAU / (PAIRS as f64 * (1.0 + thin));
    let angle = |corner: usize| {
        let corner = corner % (2 * PAIRS);
        let pairs = (corner / 2) as f64 * (1.0 + thin);
        (pairs + (corner % 2) as f64) * wide_angle
    };
    let place = |p: DVec3| DVec3::new(0.0, 1.3, 0.0) + tilt() * p;
    let at = |corner: usize, end: f64| {
        let (sin, cos) = angle(corner).sin_cos();
        place(DVec3::new(end, 0.75 * cos, 0.75 * sin))
    };
    let ends = [-0.8, 0.8];
    let middles = ends.map(|end| place(DVec3::new(end, 0.0, 0.0)));
    let mut triangles: Vec<Triangle> = Vec::new();
    for corner in 0..2 * PAIRS {
        let [near, far] = ends.map(|end| [at(corner, end), at(corner + 1, end)]);
        triangles.extend([
            [near[0], far[1], far[0]],
            [near[0], near[1], far[1]],
            [middles[0], near[1], near[0]],
            [middles[1], far[0], far[1]],
        ]);
    }
    over_ground([part("prism", &triangles)])
}

/// A sphere with a triangle without area on so large a part of its edges: from end to end by way of the
/// middle, exactly.
pub(super) fn collinear(share: f64, seed: u64) -> Shot {
    const STEPS_PER_UNIT: f64 = 1024.0;
    // So coarse that the middle of two vertices needs no rounding.
    let coarse = |p: DVec3| (p * STEPS_PER_UNIT).round() / STEPS_PER_UNIT;
    let sphere = sphere(DVec3::new(0.0, 1.3, 0.0), 0.9, 12);
    let mut triangles: Vec<Triangle> = sphere.iter().map(|t| t.map(coarse)).collect();
    let mut seen = HashSet::new();
    let bits = |p: DVec3| p.to_array().map(f64::to_bits);
    let mut edges: Vec<[DVec3; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .filter(|&[a, b]| !seen.contains(&[bits(b), bits(a)]) && seen.insert([bits(a), bits(b)]))
        .collect();
    edges.shuffle(&mut random(seed));
    let count = (share * edges.len() as f64).round() as usize;
    let flat = edges[..count].iter().map(|&[a, b]| [a, b, (a + b) / 2.0]);
    triangles.extend(flat);
    over_ground([part("sphere", &triangles)])
}

/// Frusta of pyramids whose tips are the light: their sides are edge-on to it. All coordinates have few digits,
/// so that the light lies in the planes exactly; then each is moved by so many ULPs. What arithmetic says of
/// the sides is rounding alone. In view is nothing but their shadow: whether such a side is itself lit is no
/// fair question.
pub(super) fn edge_on(ulps: usize, seed: u64) -> Shot {
    let mut random = random(seed);
    let r = &mut random;
    let light = coarse(DVec3::new(0.713, 5.817, 0.431));
    // Shadow volumes may end where the scene ends: with nothing below the ground, a leak below it would never
    // come to be drawn.
    let below = sphere(DVec3::new(0.3, -7.0, -0.2), 0.5, 8);
    let mut parts = vec![ground(8.0), part("ball", &below)];
    for (row, column) in (0..4).flat_map(|row| (0..5).map(move |column| (row, column))) {
        let place = DVec3::new(f64::from(column) - 1.7, 0.0, f64::from(row) - 2.6) * 0.7;
        let height = DVec3::Y * r.random_range(1.4..1.9);
        let name = format!("frustum {row} {column}");
        parts.push(frustum(&name, light, place + height, ulps, r));
    }
    Shot {
        parts,
        light: light.extend(1.0),
        eye: DVec3::new(0.17, 1.05, 1.9),
        target: DVec3::new(-0.1, 0.0, 0.1),
        near: 0.1,
    }
}

/// To a grid on which half the way from one point to another takes one digit more.
fn coarse(p: DVec3) -> DVec3 {
    const STEPS_PER_UNIT: f64 = 4096.0;
    (p * STEPS_PER_UNIT).round() / STEPS_PER_UNIT
}

/// One frustum, see [`edge_on`].
fn frustum(name: &str, light: DVec3, centre: DVec3, ulps: usize, random: &mut impl Rng) -> Part {
    let sides = random.random_range(3..8u32);
    let lean = random.random_range(-0.5..0.5);
    let start = random.random_range(0.0..TAU);
    let lower = (0..sides).map(|i| {
        let (sin, cos) = (start + TAU * f64::from(i) / f64::from(sides)).sin_cos();
        coarse(centre + 0.23 * DVec3::new(cos, lean * sin, sin))
    });
    let lower: Vec<DVec3> = lower.collect();
    // Half-way: the longer an edge, the more is lost in the rounding of what it is multiplied with.
    let upper = lower.iter().map(|&p| p.midpoint(light));
    let ulps = ulps as i32;
    let mut moved = |p: DVec3| {
        let number = |x: f32| {
            let by = if random.random_bool(0.5) { ulps } else { -ulps };
            f32::from_bits(x.to_bits().wrapping_add_signed(by))
        };
        Vec3::from_array(p.as_vec3().to_array().map(number))
    };
    let corners = lower.iter().copied().chain(upper);
    let positions: Vec<Vec3> = corners.map(&mut moved).collect();
    let mut triangles = Vec::new();
    for i in 0..sides {
        let next = (i + 1) % sides;
        let [below, above] = [[i, next], [sides + i, sides + next]];
        triangles.extend([
            [below[0], above[1], below[1]],
            [below[0], above[0], above[1]],
        ]);
        if i >= 1 && next != 0 {
            triangles.extend([[0, i, next], [sides, sides + next, sides + i]]);
        }
    }
    Part::new(name, &positions, triangles)
}
