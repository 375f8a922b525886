//! An everyday scene in other places and sizes, and under other lights.

use super::shapes::{Shot, Triangle, cuboid, part, sheet, sphere, tilt};
use glam::{DQuat, DVec3};

/// Objects of an everyday scene on a ground of 4 × 4 units around the origin, by name.
fn objects() -> Vec<(&'static str, Vec<Triangle>)> {
    let corners = [[-2.0, 2.0], [2.0, 2.0], [2.0, -2.0], [-2.0, -2.0]];
    let ground = sheet(corners.map(|[x, z]| DVec3::new(x, 0.0, z)));
    let turn = DQuat::from_rotation_y(0.61);
    vec![
        ("ground", ground.to_vec()),
        ("ball", sphere(DVec3::new(-0.31, 0.33, 0.12), 0.21, 12)),
        ("small ball", sphere(DVec3::new(0.42, 0.17, 0.51), 0.13, 10)),
        (
            "box",
            cuboid(
                DVec3::new(0.37, 0.21, -0.42),
                DVec3::new(0.15, 0.2, 0.1),
                turn,
            ),
        ),
        (
            "leaning box",
            cuboid(DVec3::new(-0.64, 0.32, -0.61), DVec3::splat(0.17), tilt()),
        ),
    ]
}

/// Behind the objects and to the left: their shadows fall to where they are seen.
const LIGHT: DVec3 = DVec3::new(-0.83, 1.31, -0.52);

/// The scene, scaled and moved.
fn everyday(scale: f64, offset: DVec3) -> Shot {
    let place = |p: DVec3| offset + scale * p;
    let parts = objects().into_iter().map(|(name, triangles)| {
        let placed: Vec<_> = triangles.iter().map(|t| t.map(place)).collect();
        part(name, &placed)
    });
    Shot {
        parts: parts.collect(),
        light: place(LIGHT).extend(1.0),
        eye: place(DVec3::new(0.37, 1.17, 1.13)),
        target: place(DVec3::new(-0.03, 0.1, -0.07)),
        near: 0.05 * scale,
    }
}

/// Moved by 10^`exponent`.
pub(super) fn translation(exponent: f64) -> Shot {
    let direction = DVec3::new(1.0, 0.37, -0.71).normalize();
    everyday(1.0, 10f64.powf(exponent) * direction)
}

/// So many times as large.
pub(super) fn scaled(scale: f64) -> Shot {
    everyday(scale, DVec3::ZERO)
}

/// The light 10^`exponent` away from the middle.
pub(super) fn light_distance(exponent: f64) -> Shot {
    let light = 10f64.powf(exponent) * LIGHT.normalize();
    Shot {
        light: light.extend(1.0),
        ..scaled(1.0)
    }
}

/// A light at infinity, so many degrees from the zenith.
pub(super) fn light_at_infinity(degrees: f64) -> Shot {
    Shot {
        light: from_zenith(degrees, 3.71).extend(0.0),
        ..scaled(1.0)
    }
}

/// The direction so many degrees from the zenith; the azimuth, in radians, goes from x to z.
pub(super) fn from_zenith(degrees: f64, azimuth: f64) -> DVec3 {
    let (across, y) = degrees.to_radians().sin_cos();
    let (sin, cos) = azimuth.sin_cos();
    DVec3::new(across * cos, y, across * sin)
}
