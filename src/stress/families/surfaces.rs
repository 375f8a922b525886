//! Surfaces that no winding fits.

use super::shapes::{Shot, Triangle, over_ground, part, sheet, tilt};
use glam::DVec3;
use std::f64::consts::TAU;

/// A strip with half a turn in it: one side, one boundary.
pub(super) fn moebius(segments: usize) -> Shot {
    let at = |segment: usize, side: bool| {
        // After a turn the strip meets itself upside down.
        let side = side != (segment == segments);
        let u = TAU * (segment % segments) as f64 / segments as f64;
        let across = if side { 0.4 } else { -0.4 };
        let radius = 0.85 + across * (u / 2.0).cos();
        let p = DVec3::new(radius * u.cos(), across * (u / 2.0).sin(), radius * u.sin());
        DVec3::new(0.0, 1.3, 0.0) + tilt() * p
    };
    let quads = (0..segments)
        .flat_map(|i| sheet([at(i, false), at(i + 1, false), at(i + 1, true), at(i, true)]));
    over_ground([part("strip", &quads.collect::<Vec<_>>())])
}

/// A tube of figure-eight section with half a turn in it: closed, and without an inside.
pub(super) fn klein_bottle(segments: usize) -> Shot {
    let n = segments;
    let at = |i: usize, j: usize| {
        let (i, j) = if i == n {
            (0, n - 1 - j % n)
        } else {
            (i, j % n)
        };
        let u = TAU * i as f64 / n as f64;
        // Half a step aside: no vertex lies where the surface goes through itself.
        let v = TAU * (j as f64 + 0.5) / n as f64;
        let (sin, cos) = (u / 2.0).sin_cos();
        let (x, y) = (v.sin(), (2.0 * v).sin());
        let radius = 0.7 + 0.4 * (cos * x - sin * y);
        let height = 0.4 * (sin * x + cos * y);
        let p = DVec3::new(radius * u.cos(), height, radius * u.sin());
        DVec3::new(0.0, 1.3, 0.0) + tilt() * p
    };
    let steps = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let quads = steps
        .flat_map(|(i, j)| sheet([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]))
        .collect::<Vec<Triangle>>();
    over_ground([part("bottle", &quads)])
}
