//! What the scenes are put together from: shapes in f64, rounded once at the end, and a picture of them.

use crate::scene::{CameraKey, CameraPath, Flight, Light, Part, Scene};
use glam::{DQuat, DVec3, DVec4, EulerRot, Vec3};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{FRAC_PI_3, PI, TAU};

/// Corners, counter-clockwise seen from outside where there is an outside. Corners that are one vertex
/// are equal bit for bit, and so stay one when they are rounded.
pub(super) type Triangle = [DVec3; 3];

/// What is drawn and from where.
pub(super) struct Shot {
    pub parts: Vec<Part>,
    /// A position with w = 1, or with w = 0 the direction towards the light.
    pub light: DVec4,
    pub eye: DVec3,
    pub target: DVec3,
    pub near: f64,
}

impl Shot {
    pub(super) fn scene(self, name: String, title: String) -> Scene {
        let key = CameraKey {
            time_s: 0.0,
            eye: self.eye.as_vec3(),
            target: self.target.as_vec3(),
        };
        let camera = CameraPath {
            keys: vec![key],
            up: Vec3::Y,
            fov_y_rad: FRAC_PI_3 as f32,
            near: self.near as f32,
        };
        let mesh = self.parts.into_iter().collect();
        let flight = Flight::under(Light::at(self.light.as_vec4()), camera);
        Scene::new(name, title, mesh, flight)
    }
}

/// The usual picture: casters about a unit in size around (0, 1.3, 0), the ground, and their shadow on it.
pub(super) fn over_ground(casters: impl IntoIterator<Item = Part>) -> Shot {
    Shot {
        parts: casters.into_iter().chain([ground(8.0)]).collect(),
        light: DVec3::new(1.73, 5.31, 1.17).extend(1.0),
        eye: DVec3::new(-1.47, 2.63, 2.47),
        target: DVec3::new(-0.21, 0.63, -0.11),
        near: 0.1,
    }
}

/// An object of these triangles, which casts a shadow.
pub(super) fn part(name: &str, triangles: &[Triangle]) -> Part {
    let rounded: Vec<_> = triangles.iter().map(|t| t.map(|p| p.as_vec3())).collect();
    Part::of_triangles(name, &rounded)
}

/// The same for everyone, so that a seed is all that a scene depends on.
pub(super) fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// A point of the cube of this half side around the origin.
pub(super) fn in_cube(random: &mut impl Rng, half: f64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| random.random_range(-half..half)))
}

/// A turn that lays no axis along another.
pub(super) fn tilt() -> DQuat {
    DQuat::from_euler(EulerRot::XYZ, 0.31, 0.53, 0.74)
}

/// The same triangle seen from behind.
pub(super) fn flipped([a, b, c]: Triangle) -> Triangle {
    [a, c, b]
}

/// A closed sphere of `slices`² triangles, `slices` even. Its poles lean, see [`tilt`].
pub(super) fn sphere(centre: DVec3, radius: f64, slices: usize) -> Vec<Triangle> {
    let rings = slices / 2;
    let lean = tilt();
    // Ring 0 and the one after the last are the poles.
    let at = |ring: usize, slice: usize| {
        let (across, y) = (PI * ring as f64 / (rings + 1) as f64).sin_cos();
        let (sin, cos) = (TAU * (slice % slices) as f64 / slices as f64).sin_cos();
        let is_pole = ring == 0 || ring == rings + 1;
        let across = if is_pole { 0.0 } else { across };
        centre + radius * (lean * DVec3::new(across * cos, y, -across * sin))
    };
    let mut triangles = Vec::with_capacity(slices * slices);
    for slice in 0..slices {
        for ring in 0..=rings {
            let [upper, lower] =
                [ring, ring + 1].map(|ring| [at(ring, slice), at(ring, slice + 1)]);
            if ring < rings {
                triangles.push([upper[0], lower[0], lower[1]]);
            }
            if ring > 0 {
                triangles.push([upper[0], lower[1], upper[1]]);
            }
        }
    }
    triangles
}

/// A closed box.
pub(super) fn cuboid(centre: DVec3, half: DVec3, turn: DQuat) -> Vec<Triangle> {
    let at = |corner: [f64; 3]| centre + turn * (half * DVec3::from_array(corner));
    let mut triangles = Vec::with_capacity(12);
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let corner = |u: f64, v: f64| {
                let mut corner = [0.0; 3];
                corner[axis] = side;
                // Turned about for the one side, so that both look counter-clockwise from outside.
                corner[(axis + 1) % 3] = u * side;
                corner[(axis + 2) % 3] = v;
                at(corner)
            };
            triangles.extend(sheet([
                corner(-1.0, -1.0),
                corner(1.0, -1.0),
                corner(1.0, 1.0),
                corner(-1.0, 1.0),
            ]));
        }
    }
    triangles
}

/// A sheet with these corners in order around it, in two triangles.
pub(super) fn sheet([a, b, c, d]: [DVec3; 4]) -> [Triangle; 2] {
    [[a, b, c], [a, c, d]]
}

/// A square at y = 0, seen from above; it casts too.
pub(super) fn ground(half: f64) -> Part {
    ground_at(DVec3::ZERO, half)
}

/// A level square around a point, seen from above.
pub(super) fn ground_at(centre: DVec3, half: f64) -> Part {
    let corners = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]];
    let corners = corners.map(|[x, z]| centre + half * DVec3::new(x, 0.0, z));
    part("ground", &sheet(corners))
}

/// A closed tetrahedron, whichever way its corners come.
pub(super) fn tetrahedron([a, b, c, d]: [DVec3; 4]) -> Vec<Triangle> {
    let faces = [[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
    let inside_out = (b - a).cross(c - a).dot(d - a) > 0.0;
    let outwards = |face| if inside_out { flipped(face) } else { face };
    faces.map(outwards).to_vec()
}
