//! Where the bias of a shadow map shows.

use super::shapes::{Shot, cuboid, ground, part, sphere};
use super::space::from_zenith;
use glam::{DQuat, DVec3};

/// A wall 10^-`exponent` thick that stands on the ground before the light; in view is its foot.
pub(super) fn thin_wall(exponent: f64) -> Shot {
    let thickness = 10f64.powf(-exponent);
    let half = DVec3::new(0.8, 0.5, thickness / 2.0);
    // Its bottom lies in the ground exactly. It grows away from the eye, which sees the same face always.
    let centre = DVec3::new(0.0, half.y, -half.z);
    let turn = DQuat::from_rotation_y(0.13);
    let wall = cuboid(turn * centre, half, turn);
    Shot {
        parts: vec![part("wall", &wall), ground(4.0)],
        light: DVec3::new(0.87, 2.9, -2.3).extend(1.0),
        eye: DVec3::new(0.87, 0.43, 0.61),
        target: DVec3::new(0.65, 0.12, 0.03),
        near: 0.02,
    }
}

/// A box on the ground under a light at infinity, so many degrees from the zenith; in view is where its
/// shadow begins.
pub(super) fn contact(degrees: f64) -> Shot {
    let half = DVec3::new(0.3, 0.1, 0.2);
    let block = cuboid(DVec3::Y * half.y, half, DQuat::from_rotation_y(0.23));
    Shot {
        parts: vec![part("box", &block), ground(3.0)],
        light: from_zenith(degrees, 0.94).extend(0.0),
        eye: DVec3::new(-0.61, 0.21, 0.17),
        target: DVec3::new(-0.27, 0.03, -0.03),
        near: 0.02,
    }
}

/// A plate whose normal is so many degrees from the light, and a ball half sunk into it.
pub(super) fn grazing_receiver(degrees: f64) -> Shot {
    let turn = DQuat::from_axis_angle(DVec3::new(0.2, 0.1, 1.0).normalize(), degrees.to_radians());
    let light = DVec3::Y * 6.0;
    // The eye turns with the plate.
    let place = |p: DVec3| turn * p;
    let plate = cuboid(place(DVec3::Y * -0.1), DVec3::new(2.0, 0.1, 1.7), turn);
    let ball = sphere(place(DVec3::new(0.41, 0.1, -0.33)), 0.45, 12);
    Shot {
        parts: vec![part("plate", &plate), part("ball", &ball)],
        light: light.extend(1.0),
        eye: place(DVec3::new(0.47, 2.4, 1.3)),
        target: place(DVec3::new(0.05, 0.0, -0.03)),
        near: 0.1,
    }
}
