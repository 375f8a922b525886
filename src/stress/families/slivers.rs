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
            [near[0], far[0], far[1]],
            [near[0], far[1], near[1]],
            [middles[0], near[1], near[0]],
            [middles[1], far[0], far[1]],
        ]);
    }
    for triangle in &mut triangles {
        // Written for an axis that points the other way.
        triangle.swap(1, 2);
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

/// Many frusta of pyramids whose tips are the light: all their sides are edge-on to it but for the rounding
/// of their vertices, and for so many ULPs that each coordinate is moved. In view is their shadow alone:
/// how light a side itself is, only its rounding decides.
pub(super) fn edge_on(ulps: usize, seed: u64) -> Shot {
    let mut random = random(seed);
    let r = &mut random;
    let light = DVec3::new(0.713, 5.317, 0.431).as_vec3().as_dvec3();
    let mut parts = vec![ground(6.0)];
    for (row, column) in (0..5).flat_map(|row| (0..5).map(move |column| (row, column))) {
        let place = DVec3::new(f64::from(column) - 2.0, 0.0, f64::from(row) - 3.3) * 0.8;
        let height = DVec3::Y * r.random_range(1.5..2.2);
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

/// One frustum, see [`edge_on`].
fn frustum(name: &str, light: DVec3, centre: DVec3, ulps: usize, random: &mut impl Rng) -> Part {
    let sides = random.random_range(3..8u32);
    let lean = random.random_range(-0.5..0.5);
    let start = random.random_range(0.0..TAU);
    let lower = (0..sides).map(|i| {
        let (sin, cos) = (start + TAU * f64::from(i) / f64::from(sides)).sin_cos();
        centre + 0.27 * DVec3::new(cos, lean * sin, sin)
    });
    let lower: Vec<DVec3> = lower.collect();
    let upper = lower.iter().map(|p| light + 0.85 * (p - light));
    let mut near_light_plane = |p: DVec3| {
        let by = |x: f32, up: bool| {
            let by = if up { ulps as i32 } else { -(ulps as i32) };
            f32::from_bits(x.to_bits().wrapping_add_signed(by))
        };
        Vec3::from_array(
            p.as_vec3()
                .to_array()
                .map(|x| by(x, random.random_bool(0.5))),
        )
    };
    let positions: Vec<Vec3> = lower
        .iter()
        .copied()
        .chain(upper)
        .map(&mut near_light_plane)
        .collect();
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
