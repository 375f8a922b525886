//! All points between a triangle and the light.

use crate::geometry::ray::Ray;
use glam::{DVec3, DVec4};

/// The points from which a triangle is behind, seen from the light: within three planes through the light and its sides, and
/// before its own.
pub(super) struct Cone {
    corners: [DVec3; 3],
    light: DVec4,
    sides: [Plane; 3],
    base: Plane,
    /// Nothing is inside or before the base that is not so by this distance.
    margin: f64,
}

#[derive(Clone, Copy)]
struct Plane {
    normal: DVec3,
    distance: f64,
}

impl Plane {
    /// With the point `inside` on its positive side, and farther away than `margin`.
    fn new(normal: DVec3, through: DVec3, inside: DVec3, margin: f64) -> Option<Self> {
        let normal = normal.try_normalize()?;
        let height = normal.dot(inside - through);
        let normal = normal * height.signum();
        let distance = normal.dot(through);
        (height.abs() > margin).then_some(Self { normal, distance })
    }

    fn height(self, point: DVec3) -> f64 {
        self.normal.dot(point) - self.distance
    }
}

impl Cone {
    /// `None` for a triangle that is edge-on to the light, or too small to tell.
    pub(super) fn new(corners: [DVec3; 3], light: DVec4, margin: f64) -> Option<Self> {
        let [a, b, c] = corners;
        let towards_light = |from: DVec3| light.truncate() - from * light.w;
        let side = |p: DVec3, q: DVec3, inside| {
            Plane::new((q - p).cross(towards_light(p)), p, inside, margin)
        };
        let before = a + towards_light(a);
        Some(Self {
            sides: [side(a, b, c)?, side(b, c, a)?, side(c, a, b)?],
            base: Plane::new((b - a).cross(c - a), a, before, margin)?,
            corners,
            light,
            margin,
        })
    }

    /// The ray to the light from the point of the triangle with these weights of its corners.
    pub(super) fn ray(&self, weights: [f64; 3]) -> Ray {
        let weighted = self.corners.iter().zip(weights);
        let from: DVec3 = weighted.map(|(corner, weight)| *corner * weight).sum();
        Ray {
            from,
            towards: self.light.truncate() - from * self.light.w,
            ends: self.light.w != 0.0,
        }
    }

    /// Whether a part of a segment may be inside its sides.
    pub(super) fn may_hold_of_segment(&self, ends: [DVec3; 2]) -> bool {
        let (mut first, mut last) = (0.0, 1.0);
        for side in self.sides {
            let [start, end] = ends.map(|end| side.height(end) + self.margin);
            if start < 0.0 && end < 0.0 {
                return false;
            }
            let crossing = start / (start - end);
            if start < 0.0 {
                first = f64::max(first, crossing);
            } else if end < 0.0 {
                last = f64::min(last, crossing);
            }
        }
        first <= last
    }

    /// Whether whatever of a triangle is inside its sides is before its base.
    pub(super) fn holds_before_base(&self, corners: [DVec3; 3]) -> bool {
        let is_before = |point: &DVec3| self.base.height(*point) > self.margin;
        if corners.iter().all(is_before) {
            return true;
        }
        let mut polygon = corners.to_vec();
        let mut inside = Vec::with_capacity(6);
        for side in self.sides {
            inside.clear();
            for (i, &p) in polygon.iter().enumerate() {
                let q = polygon[(i + 1) % polygon.len()];
                let [of_p, of_q] = [p, q].map(|point| side.height(point) + self.margin);
                if of_p >= 0.0 {
                    inside.push(p);
                }
                if (of_p >= 0.0) != (of_q >= 0.0) {
                    inside.push(p.lerp(q, of_p / (of_p - of_q)));
                }
            }
            std::mem::swap(&mut polygon, &mut inside);
        }
        polygon.iter().all(is_before)
    }
}
