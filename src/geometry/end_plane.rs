//! Where shadow volumes may end: no farther than the scene reaches.
//!
//! A volume must be closed, but it need not be infinite: beyond the last surface that could receive its
//! shadow, nothing is there to be counted. If a plane has the whole scene on one side, and light falls
//! through it from every caster, all volumes may end on it. What is then between the plane and infinity
//! is neither rasterised nor counted, which for volumes seen from the side is most of them.

use super::Bounds;
use glam::{DVec3, Vec4};

/// The plane at infinity, in the form of [`end_plane`].
pub const AT_INFINITY: Vec4 = Vec4::W;

/// The plane lies this part of the scene's size beyond the scene.
const MARGIN: f64 = 1e-3;

/// And at least this part of the largest coordinate: far from the origin, the shaders' single precision
/// must still tell the plane from the scene.
const ROUNDING: f64 = 1e-5;

/// A caster at this part of the light's distance from the plane is the farthest from the plane that is
/// allowed: beyond it, far ends would be flung too far away, and above it there would be none.
const MAX_HEIGHT: f64 = 0.9;

/// The plane on which all shadow volumes may end: the coefficients e, with e · (p, 1) ≥ 0 for all of
/// the scene; [`AT_INFINITY`] where there is no such plane among the sides of the scene's box.
///
/// The point on it in the shadow of p is (e · l) p − (e · p) l, for a light l at a point (w = 1) or at
/// infinity (w = 0). The plane at infinity, (0, 0, 0, 1), gives p − l and −l with w = 0.
pub fn end_plane(scene: Bounds, casters: Bounds, light: Vec4) -> Vec4 {
    if scene.is_empty() || casters.is_empty() {
        return AT_INFINITY;
    }
    let size = (scene.high - scene.low).max_element();
    let light_at = light.truncate().as_dvec3();
    let largest = scene.low.abs().max(scene.high.abs()).max_element();
    let margin = (MARGIN * size).max(ROUNDING * largest.max(light_at.abs().max_element()));
    let is_point = light.w != 0.0;
    let sides = [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .flat_map(|axis| [axis, -axis]);
    let candidates = sides.filter_map(|inward| {
        let distance = margin - scene.range_along(inward).0;
        // Smaller is better: how far the farthest ends are flung.
        let height = if is_point {
            let of_light = inward.dot(light_at) + distance;
            let of_casters = casters.range_along(inward).1 + distance;
            (of_light > 0.0).then(|| of_casters / of_light)
        } else {
            let cosine = inward.dot(light_at.normalize());
            (cosine > 0.0).then_some(1.0 - cosine)
        }?;
        (height <= MAX_HEIGHT).then(|| (height, inward.extend(distance).as_vec4()))
    });
    candidates
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(AT_INFINITY, |(_, plane)| plane)
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
    fn a_lamp_from_the_side_ends_at_the_other_side() {
        let plane = end_plane(SCENE, CASTERS, Vec4::new(60.0, 1.0, 0.0, 1.0));
        assert_eq!(plane.truncate(), glam::Vec3::X);
        assert!(plane.w > 40.0);
    }
}
