//! The light in a mesh, close to it and on it.

use super::shapes::{Shot, Triangle, ground_at, over_ground, part, random, sphere, tetrahedron};
use crate::scene::Part;
use glam::DVec3;
use rand::seq::SliceRandom;

/// The light on its way from outside a closed sphere to its centre: at 0.5 it is on the surface. Inside,
/// nothing that can be seen is lit.
pub(super) fn in_mesh(share: f64) -> Shot {
    let centre = DVec3::new(0.11, 1.5, -0.13);
    let ball = sphere(DVec3::new(-1.3, 0.5, 0.6), 0.4, 10);
    let light = centre + (1.0 - share) * DVec3::new(0.83, 1.02, 0.67).normalize() * 2.4;
    Shot {
        light: light.extend(1.0),
        ..over_ground([part("shell", &sphere(centre, 1.2, 12)), part("ball", &ball)])
    }
}

/// The same with windows in the sphere: what shines through them is lit.
pub(super) fn in_lantern(share: f64, seed: u64) -> Shot {
    let centre = DVec3::new(0.11, 1.4, -0.13);
    let mut shade: Vec<Triangle> = sphere(centre, 0.8, 12);
    shade.shuffle(&mut random(seed));
    let light = centre + (1.0 - share) * DVec3::new(0.83, 1.32, 0.67).normalize() * 2.4;
    Shot {
        light: light.extend(1.0),
        ..over_ground([part("shade", &shade[shade.len() * 2 / 5..])])
    }
}

/// Some balls on the ground, around a body at the origin.
fn around(body: &[Triangle], light: DVec3) -> Shot {
    let floor = DVec3::new(0.0, -1.6, 0.0);
    let balls = [[2.1, 0.4], [-2.0, -1.7], [0.9, -2.6], [-1.4, 1.3]];
    let balls = balls.iter().enumerate().map(|(i, &[x, z])| {
        let ball = sphere(floor + DVec3::new(x, 0.4, z), 0.3, 8);
        part(&format!("ball {i}"), &ball)
    });
    let parts: Vec<Part> = [part("body", body), ground_at(floor, 6.0)]
        .into_iter()
        .chain(balls)
        .collect();
    Shot {
        parts,
        light: light.extend(1.0),
        eye: DVec3::new(2.3, 2.2, 3.4),
        target: DVec3::new(0.0, -0.9, -0.7),
        near: 0.1,
    }
}

/// Corners with few digits, so that the origin lies exactly where it should.
fn coarse<const N: usize>(corners: [[f64; 3]; N]) -> [DVec3; N] {
    corners.map(|corner| (DVec3::from_array(corner) * 256.0).round() / 256.0)
}

/// The light over the top of a tetrahedron, at the origin.
pub(super) fn near_vertex(distance: f64) -> Shot {
    let [a, b, c] = coarse([[-0.9, -0.7, 0.5], [0.8, -0.9, 0.6], [0.1, -0.8, -1.1]]);
    let away = DVec3::new(0.31, 0.93, 0.17).normalize();
    around(&tetrahedron([DVec3::ZERO, a, b, c]), distance * away)
}

/// The light over the upper edge of a tetrahedron, whose middle is the origin.
pub(super) fn near_edge(distance: f64) -> Shot {
    let [end, c, d] = coarse([[0.9, 0.25, 0.4], [-0.2, -0.9, 0.7], [0.3, -1.0, -0.8]]);
    let away = end.cross(DVec3::new(0.47, 0.11, -1.0)).normalize();
    let up = if away.y > 0.0 { away } else { -away };
    around(&tetrahedron([end, -end, c, d]), distance * up)
}

/// The light over a face of a tetrahedron, whose centre is the origin. The face leans back: what is far
/// behind it stays lit.
pub(super) fn near_face(distance: f64) -> Shot {
    let [a, b, below] = coarse([[0.9, 0.5, 0.45], [-0.8, 0.55, 0.55], [0.1, -1.2, 0.6]]);
    let c = -(a + b);
    let normal = (b - a).cross(c - a).normalize();
    let up = if normal.y > 0.0 { normal } else { -normal };
    around(&tetrahedron([a, b, c, below]), distance * up)
}

/// The light half a unit away from all, or exactly on a vertex, an edge or a face.
pub(super) fn on_element(element: usize) -> Shot {
    match element {
        0 => near_vertex(0.5),
        1 => near_vertex(0.0),
        2 => near_edge(0.0),
        _ => near_face(0.0),
    }
}
