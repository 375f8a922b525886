//! The near volume: all points between the near rectangle and the light.
//!
//! A point of the near rectangle is in shadow exactly if something lies between it and the light. So a
//! caster outside the near volume leaves the whole near rectangle outside its shadow volume, and what
//! of that volume is in front of a visible surface is then in view: counting z-pass is right. (Everitt
//! and Kilgard 2002, section 5.4.)

use super::Bounds;
use glam::{DVec3, Vec4};

/// Distances are taken to be uncertain by this part of the largest coordinate: vertices and matrices
/// are rounded to 24 bits several times on their way to the screen.
const MARGIN: f64 = 1e-5;

/// An axis whose cosine with the direction of a light at infinity is smaller is taken to be across it.
const ACROSS: f64 = 1e-12;

/// The convex hull of the near rectangle and the light.
///
/// Separation is tested along some axes only. Any axis that separates proves that nothing of a box is
/// in the volume; if none does, the box may be in it or not. No axis can be a wrong one, so there are no
/// special cases: a light in the near plane makes the volume flat, nothing else.
#[derive(Debug, Clone)]
pub struct NearVolume {
    /// Axes, and the range of the volume along each, margin included.
    ranges: Vec<(DVec3, f64, f64)>,
}

impl NearVolume {
    /// From the corners of the near rectangle, in order around it, and the light: a point with w = 1,
    /// or with w = 0 the direction towards it.
    pub fn new(corners: [DVec3; 4], light: Vec4) -> Self {
        let towards = |from: DVec3| light.truncate().as_dvec3() - from * f64::from(light.w);
        let sides = (0..4).map(|i| (corners[(i + 1) % 4] - corners[i]).cross(towards(corners[i])));
        let plane = (corners[1] - corners[0]).cross(corners[3] - corners[0]);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, plane]
            .into_iter()
            .chain(sides);
        let light_point = light.truncate().as_dvec3();
        let is_point = light.w != 0.0;
        let points = corners.iter().chain(is_point.then_some(&light_point));
        let size = points
            .clone()
            .fold(0.0, |size: f64, p| size.max(p.abs().max_element()));
        let range = |axis: DVec3| {
            let along = points.clone().map(|p| axis.dot(*p));
            let (mut low, mut high) = along
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), d| {
                    (l.min(d), h.max(d))
                });
            if !is_point {
                // The volume goes on for ever towards the light, but for axes across it; these are
                // normals of its sides, and across it but for rounding in double precision.
                let slope = axis.dot(light_point.normalize());
                if slope > ACROSS {
                    high = f64::INFINITY;
                } else if slope < -ACROSS {
                    low = f64::NEG_INFINITY;
                }
            }
            (axis, low - MARGIN * size, high + MARGIN * size)
        };
        Self {
            // A flat volume has sides without a normal.
            ranges: axes
                .filter_map(|axis| axis.try_normalize())
                .map(range)
                .collect(),
        }
    }

    /// Whether something in the box may cast a shadow on a point of the near rectangle. Errs to true.
    pub fn may_meet(&self, bounds: Bounds) -> bool {
        if bounds.is_empty() {
            return false;
        }
        let size = bounds.low.abs().max(bounds.high.abs()).max_element();
        self.ranges.iter().all(|&(axis, low, high)| {
            let (first, last) = bounds.range_along(axis);
            last + MARGIN * size >= low && first - MARGIN * size <= high
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use proptest::prelude::*;

    fn rectangle(centre: DVec3, right: DVec3, up: DVec3) -> [DVec3; 4] {
        [
            centre - right - up,
            centre + right - up,
            centre + right + up,
            centre - right + up,
        ]
    }

    fn cube(centre: DVec3, half: f64) -> Bounds {
        Bounds {
            low: centre - half,
            high: centre + half,
        }
    }

    #[test]
    fn what_is_between_light_and_near_rectangle_meets_and_what_is_beside_does_not() {
        let near = rectangle(DVec3::ZERO, DVec3::X, DVec3::Y);
        let light = Vec4::new(0.0, 10.0, 0.0, 1.0);
        for (light, is_flat) in [(light, true), (Vec4::new(0.0, 5.0, 5.0, 1.0), false)] {
            let volume = NearVolume::new(near, light);
            let halfway = light.truncate().as_dvec3() / 2.0;
            assert!(volume.may_meet(cube(halfway, 0.1)));
            assert!(!volume.may_meet(cube(halfway + DVec3::X * 2.0, 0.1)));
            assert!(!volume.may_meet(cube(DVec3::NEG_Z, 0.1)));
            assert!(!volume.may_meet(cube(light.truncate().as_dvec3() * 1.2, 0.1)));
            let before_the_eye = cube(DVec3::new(0.0, 0.0, 2.0), 0.1);
            assert!(!volume.may_meet(before_the_eye), "flat: {is_flat}");
        }
        assert!(!NearVolume::new(near, light).may_meet(Bounds::EMPTY));
    }

    #[test]
    fn a_light_at_infinity_is_behind_everything_on_its_side() {
        let near = rectangle(DVec3::ZERO, DVec3::X, DVec3::Y);
        let volume = NearVolume::new(near, Vec4::new(0.0, 3.0, 4.0, 0.0));
        assert!(volume.may_meet(cube(DVec3::new(0.0, 300.0, 400.0), 1.0)));
        assert!(!volume.may_meet(cube(DVec3::new(0.0, -300.0, -400.0), 1.0)));
        assert!(!volume.may_meet(cube(DVec3::new(3.0, 300.0, 400.0), 1.0)));
    }

    #[test]
    fn a_light_at_infinity_that_is_nearly_along_an_axis_still_slopes() {
        let near = rectangle(DVec3::ZERO, DVec3::Y, DVec3::Z);
        let volume = NearVolume::new(near, Vec4::new(1.0, 9e-6, 0.0, 0.0));
        // So far away that the slope has left the near rectangle's own height behind.
        assert!(volume.may_meet(cube(DVec3::new(1e6, 9.0, 0.0), 0.5)));
        assert!(!volume.may_meet(cube(DVec3::new(1e6, 60.0, 0.0), 0.5)));
    }

    fn vector(size: f32) -> impl Strategy<Value = Vec3> {
        [-size..size, -size..size, -size..size].prop_map(Vec3::from_array)
    }

    proptest! {
        /// Whatever holds a point that shadows the near rectangle is found.
        #[test]
        fn errs_on_the_safe_side(
            centre in vector(20.0),
            right in vector(1.0),
            up in vector(1.0),
            light in vector(30.0),
            is_point in prop::bool::ANY,
            at in (-1.0f64..1.0, -1.0f64..1.0, 0.0f64..1.0),
            half in 0.0f64..3.0,
            shift in (-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0),
        ) {
            let [centre, right, up] = [centre, right, up].map(Vec3::as_dvec3);
            prop_assume!(light.length() > 1e-3);
            let homogeneous = light.extend(f32::from(u8::from(is_point)));
            let on_near = centre + right * at.0 + up * at.1;
            let towards = light.as_dvec3() - on_near * f64::from(u8::from(is_point));
            let blocker = on_near + towards * at.2;
            let bounds = cube(blocker + DVec3::new(shift.0, shift.1, shift.2) * half, half);
            let volume = NearVolume::new(rectangle(centre, right, up), homogeneous);
            prop_assert!(volume.may_meet(bounds));
        }
    }
}
