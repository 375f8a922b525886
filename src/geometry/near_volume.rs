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
pub(super) const MARGIN: f64 = 1e-5;

/// An axis whose cosine with the direction of a light at infinity is smaller is taken to be across it.
const ACROSS: f64 = 1e-12;

/// The convex hull of the near rectangle and the light.
///
/// Separation is tested along some axes only. Any axis that separates proves that nothing of a box is
/// in the volume; if none does, the box may be in it or not. No axis can be a wrong one, so there are no
/// special cases: a light in the near plane makes the volume flat, nothing else.
#[derive(Debug, Clone)]
pub struct NearVolume {
    corners: [DVec3; 4],
    light: Vec4,
    /// Axes, and the range of the volume along each, margin included.
    ranges: Vec<(DVec3, f64, f64)>,
}

impl NearVolume {
    /// From the corners of the near rectangle, in order around it, and the light: a point with w = 1,
    /// or with w = 0 the direction towards it.
    pub fn new(corners: [DVec3; 4], light: Vec4) -> Self {
        let mut volume = Self {
            corners,
            light,
            ranges: Vec::new(),
        };
        let sides = (0..4)
            .map(|i| (corners[(i + 1) % 4] - corners[i]).cross(volume.towards_light(corners[i])));
        let plane = (corners[1] - corners[0]).cross(corners[3] - corners[0]);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z, plane]
            .into_iter()
            .chain(sides);
        // A flat volume has sides without a normal.
        volume.ranges = axes
            .filter_map(|axis| axis.try_normalize())
            .map(|axis| {
                let (low, high) = volume.range_along(axis);
                (axis, low, high)
            })
            .collect();
        volume
    }

    /// The corners of the near rectangle, in order around it.
    pub fn near_rectangle(&self) -> [DVec3; 4] {
        self.corners
    }

    fn towards_light(&self, from: DVec3) -> DVec3 {
        self.light.truncate().as_dvec3() - from * f64::from(self.light.w)
    }

    /// The range of the volume along an axis of length 1, margin included.
    fn range_along(&self, axis: DVec3) -> (f64, f64) {
        let light_point = self.light.truncate().as_dvec3();
        let is_point = self.light.w != 0.0;
        let points = || self.corners.iter().chain(is_point.then_some(&light_point));
        let margin = MARGIN * largest_coordinate(points());
        let (mut low, mut high) = range(axis, points());
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
        (low - margin, high + margin)
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

    /// Whether a point of an edge may shadow a point of the near rectangle. Errs to true.
    pub fn may_meet_segment(&self, ends: [DVec3; 2]) -> bool {
        let margin = MARGIN * largest_coordinate(&ends);
        let meets = |axis: DVec3, low: f64, high: f64| {
            let (first, last) = range(axis, &ends);
            last + margin >= low && first - margin <= high
        };
        let [a, b, _, d] = self.corners;
        let edges = [b - a, d - a]
            .into_iter()
            .chain(self.corners.map(|corner| self.towards_light(corner)));
        let across = || edges.filter_map(|edge| edge.cross(ends[1] - ends[0]).try_normalize());
        self.ranges
            .iter()
            .all(|&(axis, low, high)| meets(axis, low, high))
            && across().all(|axis| {
                let (low, high) = self.range_along(axis);
                meets(axis, low, high)
            })
    }

    /// Whether a triangle may have a point on the near rectangle. Errs to true.
    pub fn may_meet_near_rectangle(&self, triangle: [DVec3; 3]) -> bool {
        let margin = MARGIN * largest_coordinate(&triangle).max(largest_coordinate(&self.corners));
        let [a, b, c] = triangle;
        let [p, q, _, r] = self.corners;
        let normals = [(b - a).cross(c - a), (q - p).cross(r - p)];
        let across = [b - a, c - b, a - c]
            .into_iter()
            .flat_map(|edge| [edge.cross(q - p), edge.cross(r - p)]);
        let separates = |axis: DVec3| {
            let (low, high) = range(axis, &self.corners);
            let (first, last) = range(axis, &triangle);
            last + margin < low || first - margin > high
        };
        !normals
            .into_iter()
            .chain(across)
            .filter_map(DVec3::try_normalize)
            .any(separates)
    }
}

fn range<'a>(axis: DVec3, points: impl IntoIterator<Item = &'a DVec3>) -> (f64, f64) {
    let along = points.into_iter().map(|p| axis.dot(*p));
    along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| {
        (low.min(d), high.max(d))
    })
}

fn largest_coordinate<'a>(points: impl IntoIterator<Item = &'a DVec3>) -> f64 {
    let sizes = points.into_iter().map(|p| p.abs().max_element());
    sizes.fold(0.0, f64::max)
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
