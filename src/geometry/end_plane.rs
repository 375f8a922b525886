//! Where shadow volumes may end: no farther than the scene reaches.
//!
//! A volume must be closed, but it need not be infinite: beyond the last surface that could receive its
//! shadow, nothing is there to be counted. If a plane has the whole scene on one side, and light falls
//! through it from every caster, all volumes may end on it. What is then between the plane and infinity
//! is neither rasterised nor counted, which for volumes seen from the side is most of them.

use super::Bounds;
use glam::{DVec3, Vec4};

/// The plane at infinity, in the form of [`EndPlanes`].
const AT_INFINITY: Vec4 = Vec4::W;

/// The planes lie this part of the scene's size beyond the scene.
const MARGIN: f64 = 1e-3;

/// And at least this part of the largest coordinate: far from the origin, the shaders' single precision
/// must still tell the plane from the scene.
const ROUNDING: f64 = 1e-5;

/// A caster at this part of the light's distance from the plane is the farthest from the plane that is
/// allowed: beyond it, far ends would be flung too far away, and above it there would be none.
const MAX_HEIGHT: f64 = 0.9;

/// Normals of the sides of a box, into it.
const INWARD: [DVec3; 6] = [
    DVec3::X,
    DVec3::NEG_X,
    DVec3::Y,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
];

/// The number of one of [`EndPlanes`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct EndPlane(u8);

impl EndPlane {
    /// The plane at infinity.
    pub const INFINITY: Self = Self(INWARD.len() as u8);

    /// How many there are.
    pub const COUNT: usize = INWARD.len() + 1;

    /// Its place in [`EndPlanes::coefficients`].
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

/// The planes on which the shadow volumes of a frame may end: beside the sides of the scene's box, and at infinity.
#[derive(Debug, Clone, Copy)]
pub struct EndPlanes {
    light: Vec4,
    /// Of the coefficients: a power of two that goes with the scene's size, so that far ends weigh as much beside near ones
    /// in scenes of any size. A side quad that is clipped is then rounded alike.
    weight: f64,
    /// How far beyond the scene each is from the origin; `None` where volumes may not end.
    distances: [Option<f64>; INWARD.len()],
}

impl EndPlanes {
    /// For a scene, as volumes of `light` may end with these corners of the near rectangle: back caps count
    /// everywhere, so nothing visible may be behind them.
    pub fn new(scene: Bounds, light: Vec4, near_rectangle: &[DVec3]) -> Self {
        if scene.is_empty() {
            return Self {
                light,
                weight: 1.0,
                distances: Default::default(),
            };
        }
        let size = (scene.high - scene.low).max_element();
        let light_at = light.truncate().as_dvec3();
        let largest = scene.low.abs().max(scene.high.abs()).max_element();
        let margin = (MARGIN * size).max(ROUNDING * largest.max(light_at.abs().max_element()));
        let distance = |inward: DVec3| {
            let distance = margin - scene.range_along(inward).0;
            let is_before = |corner: &DVec3| inward.dot(*corner) + distance > 0.0;
            near_rectangle.iter().all(is_before).then_some(distance)
        };
        Self {
            light,
            weight: size.max(f64::MIN_POSITIVE).log2().floor().exp2().recip(),
            distances: INWARD.map(distance),
        }
    }

    /// The coefficients e of each plane, with e · (p, 1) ≥ 0 for all of the scene; those of space are a normal into it, of
    /// a length of 1 over about the scene's size.
    ///
    /// The point on it in the shadow of p is (e · l) p − (e · p) l, for a light l at a point (w = 1) or at
    /// infinity (w = 0). The plane at infinity, (0, 0, 0, 1), gives p − l and −l with w = 0.
    pub fn coefficients(&self) -> [Vec4; EndPlane::COUNT] {
        let mut planes = [AT_INFINITY; EndPlane::COUNT];
        for ((plane, inward), distance) in planes.iter_mut().zip(INWARD).zip(self.distances) {
            if let Some(distance) = distance {
                *plane = (inward.extend(distance) * self.weight).as_vec4();
            }
        }
        planes
    }

    /// Where the volumes of what casts within a box may end: on the plane that flings their far ends least;
    /// [`EndPlane::INFINITY`] where none will do.
    pub fn of(&self, casters: Bounds) -> EndPlane {
        if casters.is_empty() {
            return EndPlane::INFINITY;
        }
        let light = self.light.truncate().as_dvec3();
        let planes = (0..).zip(INWARD).zip(self.distances);
        let candidates = planes.filter_map(|((number, inward), distance)| {
            let distance = distance?;
            // Smaller is better: how far the farthest ends are flung.
            let height = if self.light.w != 0.0 {
                let of_light = inward.dot(light) + distance;
                let of_casters = casters.range_along(inward).1 + distance;
                (of_light > 0.0).then(|| of_casters / of_light)
            } else {
                let cosine = inward.dot(light.normalize());
                (cosine > 0.0).then_some(1.0 - cosine)
            }?;
            (height <= MAX_HEIGHT).then_some((height, EndPlane(number)))
        });
        candidates
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(EndPlane::INFINITY, |(_, plane)| plane)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: Bounds = Bounds {
        low: DVec3::new(-40.0, 0.0, -40.0),
        high: DVec3::new(40.0, 2.5, 40.0),
    };
    const CASTERS: Bounds = Bounds {
        low: DVec3::new(-12.0, 0.2, -12.0),
        high: DVec3::new(12.0, 2.3, 12.0),
    };

    fn end_plane(scene: Bounds, casters: Bounds, light: Vec4) -> Vec4 {
        let planes = EndPlanes::new(scene, light, &[]);
        let plane = planes.coefficients()[planes.of(casters).index()];
        let length = plane.truncate().length();
        if length > 0.0 { plane / length } else { plane }
    }

    #[test]
    fn under_a_lamp_it_is_the_floor() {
        for light in [
            Vec4::new(3.0, 20.0, 5.0, 1.0),
            Vec4::new(0.3, 1.0, 0.2, 0.0),
        ] {
            let plane = end_plane(SCENE, CASTERS, light);
            assert_eq!(plane.truncate(), glam::Vec3::Y, "{light}");
            assert!(plane.w > 0.0 && plane.w < 0.1, "{plane}");
        }
    }

    #[test]
    fn far_ends_weigh_alike_in_scenes_of_any_size() {
        let light = Vec4::new(3.0, 20.0, 5.0, 1.0);
        let end = |scale: f32| {
            let scaled = |bounds: Bounds| Bounds {
                low: bounds.low * f64::from(scale),
                high: bounds.high * f64::from(scale),
            };
            let light = (light.truncate() * scale).extend(1.0);
            let planes = EndPlanes::new(scaled(SCENE), light, &[]);
            let plane = planes.coefficients()[planes.of(scaled(CASTERS)).index()];
            let p = (Vec4::new(1.0, 2.0, 3.0, 0.0) * scale).with_w(1.0);
            let end = p * plane.dot(light) - light * plane.dot(p);
            (end.truncate() / scale).extend(end.w)
        };
        assert_eq!(end(1.0), end(1.0 / 4096.0));
        assert_eq!(end(1.0), end(1024.0));
    }

    #[test]
    fn among_casters_it_is_at_infinity() {
        let among = Vec4::new(0.0, 1.0, 0.0, 1.0);
        assert_eq!(end_plane(SCENE, CASTERS, among), AT_INFINITY);
        assert_eq!(end_plane(SCENE, SCENE, among), AT_INFINITY);
        assert_eq!(end_plane(Bounds::EMPTY, Bounds::EMPTY, among), AT_INFINITY);
    }

    #[test]
    fn far_from_the_origin_the_plane_is_still_beyond_the_scene() {
        let shift = DVec3::new(1e5, -3e5, 2e5);
        let moved = |bounds: Bounds| Bounds {
            low: bounds.low + shift,
            high: bounds.high + shift,
        };
        let light = (DVec3::new(3.0, 20.0, 5.0) + shift).as_vec3().extend(1.0);
        let plane = end_plane(moved(SCENE), moved(CASTERS), light);
        let lowest = (SCENE.low + shift).as_vec3().extend(1.0);
        // As the shaders compute it.
        let terms = plane * lowest;
        let of_lowest = terms.x + terms.y + terms.z + terms.w;
        assert!(of_lowest > 0.5, "{plane} {of_lowest}");
    }

    #[test]
    fn what_is_seen_from_beyond_a_plane_does_not_end_there() {
        let light = Vec4::new(3.0, 20.0, 5.0, 1.0);
        let planes = EndPlanes::new(SCENE, light, &[DVec3::new(0.0, -1.0, 0.0)]);
        assert_eq!(planes.of(CASTERS), EndPlane::INFINITY);
    }

    #[test]
    fn in_a_room_each_wall_ends_beyond_itself() {
        let room = Bounds {
            low: DVec3::splat(-10.0),
            high: DVec3::splat(10.0),
        };
        let planes = EndPlanes::new(room, Vec4::W, &[]);
        assert_eq!(planes.of(room), EndPlane::INFINITY);
        for (side, inward) in INWARD.into_iter().enumerate() {
            let at = inward * -9.0;
            let wall = Bounds {
                low: at - 0.5,
                high: at + 0.5,
            };
            assert_eq!(planes.of(wall).index(), side);
        }
    }

    #[test]
    fn a_lamp_from_the_side_ends_at_the_other_side() {
        let plane = end_plane(SCENE, CASTERS, Vec4::new(60.0, 1.0, 0.0, 1.0));
        assert_eq!(plane.truncate(), glam::Vec3::X);
        assert!(plane.w > 40.0);
    }
}
