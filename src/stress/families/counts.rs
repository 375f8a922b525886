//! Many surfaces over one another: high multiplicities of an edge, high counts of a pixel.

use super::shapes::{Shot, Triangle, flipped, in_cube, over_ground, part, random, sheet, sphere};
use glam::{DQuat, DVec3};
use rand::RngExt;
use std::f64::consts::TAU;

/// Pages around one edge, all on the same side of the light plane through it: the multiplicity of the edge
/// is the number of pages.
pub(super) fn fan(pages: usize, seed: u64) -> Shot {
    let mut random = random(seed);
    let spine = [DVec3::new(0.8, 2.0, -0.7), DVec3::new(0.5, 0.8, 0.8)];
    let along = (spine[1] - spine[0]).normalize();
    // Across the spine and the light, away from the eye; then pages open to 75 degrees on either side.
    let middle = along.cross(DVec3::new(0.3, 1.0, 0.2)).normalize();
    let away = if middle.x < 0.0 { middle } else { -middle };
    let triangles: Vec<Triangle> = (0..pages)
        .map(|page| {
            let place = (page as f64 + random.random_range(0.2..0.8)) / pages as f64;
            let turn = DQuat::from_axis_angle(along, (place - 0.5) * 2.6);
            let centre = spine[0].lerp(spine[1], random.random_range(0.35..0.65));
            let length = random.random_range(0.9..1.2);
            [spine[0], spine[1], centre + length * (turn * away)]
        })
        .collect();
    over_ground([part("fan", &triangles)])
}

/// Closed shells in one another: the ground behind is in as many shadow volumes.
pub(super) fn nested_shells(count: usize) -> Shot {
    let radius = |shell: usize| 0.8 - 0.1 * shell as f64 / count as f64;
    let centre = DVec3::new(0.0, 1.3, 0.0);
    let shells = (0..count).flat_map(|shell| sphere(centre, radius(shell), 6));
    over_ground([part("shells", &shells.collect::<Vec<_>>())])
}

/// Open sheets over one another.
pub(super) fn stacked_sheets(count: usize) -> Shot {
    let sheets = (0..count).flat_map(|i| {
        let height = 1.2 + 0.3 * i as f64 / count as f64;
        // A little turned each, so that no two edges lie in one light plane.
        let turn = DQuat::from_rotation_y(0.4 + 0.1 * i as f64 / count as f64)
            * DQuat::from_rotation_x(0.11);
        let corners = [[-0.7, 0.8], [0.7, 0.8], [0.7, -0.8], [-0.7, -0.8]];
        sheet(corners.map(|[x, z]| DVec3::Y * height + turn * DVec3::new(x, 0.0, z)))
    });
    over_ground([part("sheets", &sheets.collect::<Vec<_>>())])
}

/// A sphere with each triangle so many times; where the seed is odd, half of them are flipped at random.
pub(super) fn duplicated(copies: usize, seed: u64) -> Shot {
    let mut random = random(seed);
    let flips = seed % 2 == 1;
    let sphere = sphere(DVec3::new(0.0, 1.3, 0.0), 0.8, 8);
    let copies = sphere
        .into_iter()
        .flat_map(|triangle| vec![triangle; copies]);
    let triangles: Vec<_> = copies
        .map(|triangle| {
            if flips && random.random_bool(0.5) {
                flipped(triangle)
            } else {
                triangle
            }
        })
        .collect();
    over_ground([part("sphere", &triangles)])
}

/// Triangles of different shape in exactly one plane, over one another.
pub(super) fn coplanar_overlap(count: usize, seed: u64) -> Shot {
    const STEPS_PER_UNIT: f64 = 64.0;
    let mut random = random(seed);
    // The axes are sums of few powers of two and the steps whole: no coordinate is ever rounded.
    let (u, v) = (
        DVec3::new(1.0, 0.25, 0.125),
        DVec3::new(-0.125, -0.375, 1.0),
    );
    let triangles: Vec<Triangle> = (0..count)
        .map(|_| {
            let around = in_cube(&mut random, 0.3);
            let start = random.random_range(0.0..TAU);
            [0.0, 1.0, 2.0].map(|third| {
                let angle = start + (third + random.random_range(-0.4..0.4)) * TAU / 3.0;
                let reach = random.random_range(0.3..1.0);
                let [x, y] = [
                    around.x + reach * angle.cos(),
                    around.y + reach * angle.sin(),
                ]
                .map(|step| (step * STEPS_PER_UNIT).round() / STEPS_PER_UNIT);
                DVec3::new(0.0, 1.25, 0.0) + x * u + y * v
            })
        })
        .collect();
    over_ground([part("triangles", &triangles)])
}
