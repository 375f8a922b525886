//! The eye, the near plane and the far plane where shadow volumes do not like them.

use super::shapes::{Shot, cuboid, ground, ground_at, part, sheet, sphere, tilt};
use glam::{DQuat, DVec3};

/// The near rectangle on its way into the shadow volume of a plate: at 0 two thirds of a unit beside it,
/// at 0.5 cut in two by its side, at 1 inside.
pub(super) fn in_volume(share: f64) -> Shot {
    const NEAR: f64 = 0.1;
    let light = DVec3::new(0.41, 6.0, 0.73);
    let (half, top) = (DVec3::new(1.0, 0.1, 1.1), 2.1);
    let plate = cuboid(DVec3::new(0.0, 2.0, 0.0), half, DQuat::IDENTITY);
    let height = 1.2;
    // The side of the volume goes through the light and the upper right edge of the plate.
    let side = light.x + (half.x - light.x) * (light.y - height) / (light.y - top);
    let middle_of_near = DVec3::new(side + 0.66 * (1.0 - 2.0 * share), height, 0.57);
    let forward = DVec3::new(-0.05, -0.42, -1.0).normalize();
    let eye = middle_of_near - NEAR * forward;
    // Smaller ones in view have a shadow of their own, lit ground around it.
    let ball = sphere(DVec3::new(side + 0.1, 0.35, -1.9), 0.3, 10);
    Shot {
        parts: vec![part("plate", &plate), part("ball", &ball), ground(6.0)],
        light: light.extend(1.0),
        eye,
        target: eye + 3.0 * forward,
        near: NEAR,
    }
}

/// A ball at 3 units from the eye, a smaller one half as far, and a near plane that comes nearer to them,
/// cuts them, and leaves them behind.
pub(super) fn near_plane_cuts_caster(near: f64) -> Shot {
    let eye = DVec3::new(0.13, 1.9, 3.1);
    let target = DVec3::new(0.0, 0.4, -1.2);
    let forward = (target - eye).normalize();
    let ball = sphere(eye + 3.0 * forward, 0.8, 16);
    let small = sphere(eye + 1.7 * forward + DVec3::new(0.62, -0.1, 0.0), 0.25, 10);
    // The wall shows the shadow of what is no longer drawn.
    let wall = sheet(
        [[-6.0, 0.0], [6.0, 0.0], [6.0, 5.0], [-6.0, 5.0]].map(|[x, y]| DVec3::new(x, y, -3.5)),
    );
    Shot {
        parts: vec![
            part("ball", &ball),
            part("small ball", &small),
            part("wall", &wall),
            ground(6.0),
        ],
        light: DVec3::new(1.37, 4.9, 3.3).extend(1.0),
        eye,
        target,
        near,
    }
}

/// A near ball on its ground, and far above in the picture a ball before a plate, 10^`exponent` away and
/// as large in the picture as ever.
pub(super) fn far_casters(exponent: f64) -> Shot {
    let distance = 10f64.powf(exponent);
    let eye = DVec3::new(0.17, 1.6, 4.2);
    let target = DVec3::new(0.0, 1.1, 0.0);
    let light = DVec3::new(-0.75, 0.83, 0.61).normalize();
    let ball = sphere(DVec3::new(-0.8, 0.7, 0.9), 0.65, 12);
    let far = eye + distance * DVec3::new(0.05, 0.3, -1.0).normalize();
    let far_ball = sphere(far + 0.25 * distance * light, 0.1 * distance, 12);
    let half = DVec3::new(0.35, 0.25, 0.01) * distance;
    let plate = cuboid(
        far,
        half,
        DQuat::from_rotation_x(-0.3) * DQuat::from_rotation_y(0.2),
    );
    Shot {
        parts: vec![
            part("ball", &ball),
            ground_at(DVec3::ZERO, 3.0),
            part("far ball", &far_ball),
            part("far plate", &plate),
        ],
        light: light.extend(0.0),
        eye,
        target,
        near: 0.1,
    }
}

/// Banners over the ground that begin before the eye and end 4 × 10^`exponent` behind it, beside it, with
/// their shadows; the ground grows with them.
pub(super) fn large_triangles(exponent: f64) -> Shot {
    let size = 4.0 * 10f64.powf(exponent);
    let banner = |x: f64, front: f64| {
        [
            DVec3::new(x - 0.2, 0.7, front),
            DVec3::new(x + 0.13, 2.1, front - 1.1),
            DVec3::new(x - 0.5, 1.1 + 0.1 * size, front + size),
        ]
    };
    let banners = [banner(-0.7, -2.0), banner(-1.6, -4.0), banner(1.9, -3.1)];
    let block = cuboid(DVec3::new(0.6, 0.31, -1.4), DVec3::splat(0.25), tilt());
    let ground = [
        DVec3::new(-2.0 * size, 0.0, 2.1 * size),
        DVec3::new(2.3 * size, 0.0, 1.9 * size),
        DVec3::new(0.1 * size, 0.0, -3.0 * size),
    ];
    Shot {
        parts: vec![
            part("banners", &banners),
            part("block", &block),
            part("ground", &[ground]),
        ],
        light: DVec3::new(2.7, 5.3, -1.1).extend(1.0),
        eye: DVec3::new(0.21, 1.3, 1.9),
        target: DVec3::new(-0.5, 0.4, -2.0),
        near: 0.1,
    }
}
