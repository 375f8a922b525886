//! Which triangles are worth asking: a bounding volume hierarchy that is only ever conservative.

use crate::geometry::box_tree;
use glam::{DVec3, Vec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::fast_stack;
use obvhs::ray::{Ray, RayHit};

/// How far boxes are inflated, relative to the largest absolute coordinate M of the scene.
///
/// Rays are traversed in f32, with unit roundoff u = 2^-24. Rounding the origin (at most 3 M from
/// zero, see [`Tree::visit_along`]) moves it by 3 M u; a slab's distance (origin subtracted, times
/// the inverse direction, itself rounded twice) errs by 4 u of that distance, at most 4 M, which
/// is as if the slab had moved by 16 M u. 32 u covers both.
const INFLATION: f32 = 1.0 / (1 << 19) as f32;

/// Boxes that touch a slab's border must not meet 0 × ∞: a finite stand-in for 1 / 0.
const LARGEST_INVERSE: f32 = 1e30;

/// A triangle, kept in the order in which the tree visits its leaves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Primitive {
    pub(super) corners: [Vec3; 3],
    /// Index in the scene.
    pub(super) triangle: u32,
    pub(super) casts: bool,
}

/// What to do after a triangle was looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Visit {
    /// Go on.
    On,
    /// Go on, but no farther along the ray than this distance.
    Within(f64),
    /// Enough.
    Stop,
}

/// All triangles of the scene; those that do not cast are needed to find what is visible.
pub(super) struct Tree {
    bvh: Bvh2,
    primitives: Vec<Primitive>,
    /// Where each triangle of the scene is in `primitives`.
    slots: Vec<u32>,
    centre: DVec3,
    radius: f64,
    /// The largest absolute coordinate.
    pub(super) scale: f64,
}

impl Tree {
    /// Builds over triangles in the order of the scene.
    pub(super) fn new(mut primitives: Vec<Primitive>) -> Self {
        let corners = || primitives.iter().flat_map(|primitive| primitive.corners);
        let scale = corners().fold(0.0, |scale: f32, corner| {
            scale.max(corner.abs().max_element())
        });
        let low = corners().fold(Vec3::INFINITY, Vec3::min).as_dvec3();
        let high = corners().fold(Vec3::NEG_INFINITY, Vec3::max).as_dvec3();
        let margin = Vec3A::splat(scale * INFLATION);
        let boxes: Vec<Aabb> = primitives
            .iter()
            .map(|primitive| {
                let bounds = Aabb::from_points(&primitive.corners.map(Vec3A::from));
                Aabb::new(bounds.min - margin, bounds.max + margin)
            })
            .collect();
        let bvh = box_tree::build(&boxes);
        let mut slots = vec![0; primitives.len()];
        for (slot, &index) in bvh.primitive_indices.iter().enumerate() {
            slots[index as usize] = slot as u32;
        }
        primitives = bvh
            .primitive_indices
            .iter()
            .map(|&index| primitives[index as usize])
            .collect();
        Self {
            bvh,
            primitives,
            slots,
            centre: (low + high) / 2.0,
            radius: (high - low).length() / 2.0,
            scale: f64::from(scale),
        }
    }

    /// Number of triangles.
    pub(super) fn len(&self) -> usize {
        self.primitives.len()
    }

    /// The triangle with this index in the scene.
    pub(super) fn primitive(&self, triangle: u32) -> &Primitive {
        &self.primitives[self.slots[triangle as usize] as usize]
    }

    /// Shows every triangle whose box holds a point, and some others.
    pub(super) fn visit_around(&self, point: DVec3, mut visit: impl FnMut(&Primitive)) {
        self.visit_along(point, DVec3::X, 0.0, |primitive| {
            visit(primitive);
            Visit::On
        });
    }

    /// Shows every triangle that the ray may meet within its reach, roughly from near to far, and
    /// some that it misses.
    pub(super) fn visit_along(
        &self,
        origin: DVec3,
        direction: DVec3,
        reach: f64,
        mut visit: impl FnMut(&Primitive) -> Visit,
    ) {
        // An eye far from the scene would lose the scene in f32: begin where the scene does.
        let skipped = ((self.centre - origin).dot(direction) - self.radius).max(0.0);
        let origin = origin + skipped * direction;
        let to_tmax = |reach: f64| ((reach - skipped) * (1.0 + 1e-6)) as f32;
        let ray = Ray {
            origin: origin.as_vec3a(),
            direction: direction.as_vec3a(),
            inv_direction: Vec3A::from_array(direction.to_array().map(inverse)),
            tmin: 0.0,
            tmax: to_tmax(reach),
        };
        let leaf = |node: &Bvh2Node, ray: &mut Ray, _: &mut RayHit| {
            let first = node.first_index as usize;
            for primitive in &self.primitives[first..first + node.prim_count as usize] {
                match visit(primitive) {
                    Visit::On => {}
                    Visit::Within(reach) => ray.tmax = to_tmax(reach),
                    Visit::Stop => return false,
                }
            }
            true
        };
        fast_stack!(u32, (96), self.bvh.max_depth, stack, {
            self.bvh
                .ray_traverse_dynamic(&mut stack, ray, &mut RayHit::none(), leaf);
        });
    }
}

fn inverse(x: f64) -> f32 {
    ((1.0 / x) as f32).clamp(-LARGEST_INVERSE, LARGEST_INVERSE)
}
