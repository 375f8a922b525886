//! The segment from a surface point to the light, and on which side of a plane its ends lie.

use glam::{DVec3, DVec4, Vec3};

use super::{RELATIVE_TOLERANCE, ReferenceError};
use crate::scene::Light;

/// Below this sine of an angle f64 cannot tell a triangle from a line: it is degenerate.
const DEGENERATE_SINE: f64 = 1e-12;

/// A light without size, in f64.
#[derive(Clone, Copy, Debug)]
pub(super) enum ExactLight {
    Point(DVec3),
    /// Towards the light, of length 1.
    Direction(DVec3),
}

impl ExactLight {
    pub(super) fn new(light: Light) -> Result<Self, ReferenceError> {
        // What a point would give must not pass for the truth of a soft shadow.
        if light.radius != 0.0 {
            return Err(ReferenceError::LightHasSize);
        }
        let xyz = light.place.as_dvec4().truncate();
        let light = match f64::from(light.place.w) {
            0.0 => xyz.try_normalize().map(Self::Direction),
            w => Some(Self::Point(xyz / w)).filter(|_| (xyz / w).is_finite()),
        };
        light.ok_or(ReferenceError::BadLight)
    }

    pub(super) fn homogeneous(self) -> DVec4 {
        match self {
            Self::Point(point) => point.extend(1.0),
            Self::Direction(direction) => direction.extend(0.0),
        }
    }
}

/// The open segment from a surface point to the light: a ray where the light is a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment {
    pub(super) start: DVec3,
    /// To the light's position, or the unit vector of its direction.
    pub(super) to_light: DVec3,
    /// Length of `to_light`.
    pub(super) length: f64,
    ends: bool,
    /// Length below which the start counts as touching a plane, and the line an edge.
    pub(super) tolerance: f64,
    /// The same for the light, which may be far from the scene.
    light_tolerance: f64,
}

impl Segment {
    pub(super) fn new(start: DVec3, light: ExactLight, scale: f64) -> Self {
        let (to_light, ends) = match light {
            ExactLight::Point(light) => (light - start, true),
            ExactLight::Direction(direction) => (direction, false),
        };
        let length = to_light.length();
        // Heights above a plane are lengths for a point and sines for a direction.
        let light_scale = if ends { length.max(scale) } else { 1.0 };
        Self {
            start,
            to_light,
            length,
            ends,
            tolerance: RELATIVE_TOLERANCE * scale,
            light_tolerance: RELATIVE_TOLERANCE * light_scale,
        }
    }

    /// The unit vector towards the light; NaN where the light lies on the start.
    pub(super) fn direction(&self) -> DVec3 {
        self.to_light / self.length
    }

    pub(super) fn reach(&self) -> f64 {
        if self.ends {
            self.length
        } else {
            f64::INFINITY
        }
    }

    /// The side of a plane on which the start lies; 0 within the tolerance.
    pub(super) fn start_side(&self, plane: &Plane) -> i8 {
        plane.side(self.start, self.tolerance)
    }

    /// The side of a plane on which the light lies; 0 within the tolerance.
    pub(super) fn light_side(&self, plane: &Plane) -> i8 {
        let height = if self.ends {
            plane.normal.dot(self.start + self.to_light - plane.origin)
        } else {
            plane.normal.dot(self.to_light)
        };
        sign_beyond(height, self.light_tolerance * plane.normal_length)
    }
}

/// The plane of a triangle. The normal is *not* of length 1; it points to the side from which the
/// corners are counter-clockwise, which is the positive side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    origin: DVec3,
    normal: DVec3,
    normal_length: f64,
}

impl Plane {
    /// `None` for a degenerate triangle.
    pub(super) fn new(corners: &[Vec3; 3]) -> Option<Self> {
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let (ab, ac, bc) = (b - a, c - a, c - b);
        let normal = ab.cross(ac);
        let normal_length = normal.length();
        let longest = ab
            .length_squared()
            .max(ac.length_squared())
            .max(bc.length_squared());
        (normal_length > DEGENERATE_SINE * longest).then_some(Self {
            origin: a,
            normal,
            normal_length,
        })
    }

    /// +1 or -1 for the side of the plane on which a point lies; 0 within the tolerance, a length.
    pub(super) fn side(&self, point: DVec3, tolerance: f64) -> i8 {
        sign_beyond(
            self.normal.dot(point - self.origin),
            tolerance * self.normal_length,
        )
    }

    /// The distance from a segment's start to where its line meets the plane.
    pub(super) fn distance_along(&self, segment: &Segment) -> f64 {
        self.normal.dot(self.origin - segment.start) / self.normal.dot(segment.direction())
    }

    pub(super) fn contains(&self, corners: &[Vec3; 3], tolerance: f64) -> bool {
        corners
            .iter()
            .all(|corner| self.side(corner.as_dvec3(), tolerance) == 0)
    }
}

/// +1 or -1; 0 within the tolerance.
fn sign_beyond(value: f64, tolerance: f64) -> i8 {
    if value.abs() <= tolerance {
        0
    } else {
        sign(value)
    }
}

pub(super) fn sign(value: f64) -> i8 {
    if value > 0.0 { 1 } else { -1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_positive_side_sees_the_corners_counter_clockwise() {
        let plane = Plane::new(&[Vec3::ZERO, Vec3::X, Vec3::Y]).unwrap();
        assert_eq!(plane.side(DVec3::Z, 0.0), 1);
        assert_eq!(plane.side(DVec3::NEG_Z, 0.0), -1);
        assert_eq!(plane.side(0.5 * DVec3::Z, 0.6), 0);
    }

    #[test]
    fn the_margin_of_a_far_light_is_an_angle() {
        let plane = Plane::new(&[Vec3::ZERO, Vec3::X, Vec3::Y]).unwrap();
        let side = |light| Segment::new(DVec3::ZERO, light, 1.0).light_side(&plane);
        for sine in [3e-10, 3e-9] {
            let direction = DVec3::new(1.0, 0.0, sine);
            let expected = i8::from(sine > RELATIVE_TOLERANCE);
            assert_eq!(side(ExactLight::Direction(direction.normalize())), expected);
            assert_eq!(side(ExactLight::Point(1e6 * direction)), expected);
        }
    }
}
