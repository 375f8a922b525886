//! Small scenes, views and an independent brute-force judge, for tests.

use glam::camera::rh::proj::directx::perspective_infinite_reverse;
use glam::camera::rh::view::look_at_mat4;
use glam::{DVec3, Vec3};

use super::view::{EyeRay, Projection};
use super::{Reference, ReferenceMask, ReferenceView, Verdict, Visibility};
use crate::scene::Light;

/// What is known of a pixel of this verdict under a light without size.
pub(crate) fn visibility(verdict: Verdict) -> Option<Visibility> {
    match verdict {
        Verdict::Background => None,
        Verdict::Lit => Some(Visibility::FULL),
        Verdict::Shadowed => Some(Visibility::NONE),
        Verdict::Ambiguous => Some(Visibility::UNKNOWN),
    }
}

/// A mask of these verdicts.
pub(crate) fn of_verdicts(width: u32, height: u32, verdicts: Vec<Verdict>) -> ReferenceMask {
    let pixels = verdicts.into_iter().map(visibility);
    ReferenceMask::new(width, height, pixels.collect()).unwrap()
}

/// Positions, triangles, and the number of triangles at the front that cast.
#[derive(Clone, Default)]
pub(crate) struct Scene {
    pub(crate) positions: Vec<Vec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) casters: u32,
}

impl Scene {
    /// Adds casters; all of them before any receiver.
    pub(crate) fn cast(mut self, corners: &[[Vec3; 3]]) -> Self {
        self.add(corners);
        self.casters = self.triangles.len() as u32;
        self
    }

    /// Adds receivers.
    pub(crate) fn receive(mut self, corners: &[[Vec3; 3]]) -> Self {
        self.add(corners);
        self
    }

    fn add(&mut self, corners: &[[Vec3; 3]]) {
        for corners in corners {
            let first = self.positions.len() as u32;
            self.positions.extend(corners);
            self.triangles.push([first, first + 1, first + 2]);
        }
    }

    pub(crate) fn reference(&self) -> Reference {
        Reference::new(&self.positions, &self.triangles, |i| i < self.casters).unwrap()
    }

    /// The ids that an exact rasteriser draws, and the verdicts on them.
    pub(crate) fn trace(&self, light: Light, view: &ReferenceView) -> (Vec<u32>, ReferenceMask) {
        let reference = self.reference();
        let ids = reference.visible_ids(view).unwrap();
        let mask = reference.trace(light, view, &ids).unwrap();
        (ids, mask)
    }

    fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|i| self.positions[i as usize].as_dvec3())
    }

    /// The verdict by asking every triangle, with textbook intersections and no tolerance.
    pub(super) fn brute_force(&self, light: Light, ray: &EyeRay, own: usize) -> Verdict {
        let [a, b, c] = self.corners(own);
        let normal = (b - a).cross(c - a);
        let distance = normal.dot(a - ray.eye) / normal.dot(ray.direction);
        let point = ray.eye + distance * ray.direction;
        let light = light.place.as_dvec4();
        let to_light = light.truncate() - light.w * point;
        if normal.dot(to_light) * normal.dot(ray.direction) > 0.0 {
            return Verdict::Shadowed;
        }
        let reach = if light.w == 0.0 { f64::INFINITY } else { 1.0 };
        let blocks = |other: usize| {
            let met = moeller_trumbore(point, to_light, self.corners(other));
            other != own && met.is_some_and(|t| 0.0 < t && t < reach)
        };
        if (0..self.casters as usize).any(blocks) {
            Verdict::Shadowed
        } else {
            Verdict::Lit
        }
    }

    /// The id seen along a ray by asking every triangle.
    pub(super) fn brute_force_id(&self, ray: &EyeRay, projection: &Projection) -> u32 {
        let seen = (0..self.triangles.len()).filter_map(|triangle| {
            let t = moeller_trumbore(ray.eye, ray.direction, self.corners(triangle))?;
            let shown = t > 0.0 && projection.beyond_near_plane(ray.eye + t * ray.direction);
            shown.then_some((t, triangle as u32 + 1))
        });
        seen.min_by(|one, other| one.0.total_cmp(&other.0))
            .map_or(0, |(_, id)| id)
    }
}

/// The multiple of `direction` at which a line meets a triangle.
fn moeller_trumbore(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac, offset) = (b - a, c - a, origin - a);
    let across = direction.cross(ac);
    let determinant = ab.dot(across);
    let u = offset.dot(across) / determinant;
    let v = direction.dot(offset.cross(ab)) / determinant;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(offset.cross(ab)) / determinant)
}

/// A view with a 60° field; `up` is -z where it looks straight down.
pub(crate) fn view(eye: Vec3, target: Vec3, width: u32, height: u32) -> ReferenceView {
    let up = if eye.x == target.x && eye.z == target.z {
        Vec3::NEG_Z
    } else {
        Vec3::Y
    };
    let projection =
        perspective_infinite_reverse(60f32.to_radians(), width as f32 / height as f32, 0.05);
    let view_projection = projection * look_at_mat4(eye, target, up);
    ReferenceView {
        width,
        height,
        view_projection,
    }
}

/// A square in the plane y = `height`, centred on the y axis, facing up.
pub(crate) fn square(half_side: f32, height: f32) -> [[Vec3; 3]; 2] {
    let at = |x: f32, z: f32| Vec3::new(x * half_side, height, z * half_side);
    let [a, b, c, d] = [at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)];
    [[a, b, c], [a, c, d]]
}

/// A closed sphere of `slices` × `slices` triangles, `slices` even.
pub(crate) fn sphere(centre: Vec3, radius: f32, slices: u32) -> Vec<[Vec3; 3]> {
    let stacks = slices / 2 + 1;
    let at = |stack: u32, slice: u32| {
        let polar = std::f32::consts::PI * stack as f32 / stacks as f32;
        let turn = std::f32::consts::TAU * (slice % slices) as f32 / slices as f32;
        // The poles must be one point each.
        let ring = if stack.is_multiple_of(stacks) {
            0.0
        } else {
            polar.sin()
        };
        centre + radius * Vec3::new(ring * turn.cos(), polar.cos(), ring * turn.sin())
    };
    let mut triangles = Vec::new();
    for stack in 0..stacks {
        for slice in 0..slices {
            let [a, b] = [at(stack, slice), at(stack, slice + 1)];
            let [c, d] = [at(stack + 1, slice), at(stack + 1, slice + 1)];
            if stack > 0 {
                triangles.push([a, b, c]);
            }
            if stack + 1 < stacks {
                triangles.push([b, d, c]);
            }
        }
    }
    triangles
}

/// Reproducible random numbers (SplitMix64).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// From 0 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, end: usize) -> usize {
        (self.unit() * end as f64) as usize
    }

    /// In the cube from -1 to 1.
    pub(crate) fn point(&mut self) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| 2.0 * self.unit() - 1.0))
    }

    /// Triangles in the cube from -1 to 1.
    pub(crate) fn soup(&mut self, triangles: usize) -> Vec<[Vec3; 3]> {
        let mut triangle = || {
            let centre = self.point();
            [(); 3].map(|()| (0.7 * centre + 0.3 * self.point()).as_vec3())
        };
        (0..triangles).map(|_| triangle()).collect()
    }
}
