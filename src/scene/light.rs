//! Where the light is: at a point, or in a direction whose length means nothing.

use glam::{DVec3, Vec3, Vec4};

use super::mesh::{Mesh, canonical};

/// A point light farther away than this many radii of the scene is a direction: seen from all of the scene it
/// is in the same place, to the last bit of a coordinate.
const FAR: f64 = (1 << 24) as f64;

/// Why there is no such light.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LightError {
    /// A number is NaN or infinite.
    #[error("a light needs finite numbers")]
    NotFinite,
    /// A direction of length 0.
    #[error("a direction towards the light has length 0; give another")]
    NoDirection,
    /// Neither a position nor a direction.
    #[error("w must be 1 (a point) or 0 (a direction), not {0}")]
    Weight(f64),
    /// A position that 32 bits do not hold.
    #[error(
        "the light is too far away for 32-bit numbers; give the direction towards it, with w = 0"
    )]
    TooFar,
}

/// The light as a user writes it: with w = 1 a position, with w = 0 the direction towards it, of any length.
pub fn light(xyz: DVec3, w: f64) -> Result<Vec4, LightError> {
    if !xyz.is_finite() {
        return Err(LightError::NotFinite);
    }
    match w {
        0.0 => direction(xyz).ok_or(LightError::NoDirection),
        1.0 if xyz.as_vec3().is_finite() => Ok(canonical(xyz.as_vec3()).extend(1.0)),
        1.0 => Err(LightError::TooFar),
        _ => Err(LightError::Weight(w)),
    }
}

/// The light of a scene with this mesh, the same for all lengths of a direction.
pub(super) fn of_scene(light: Vec4, mesh: &Mesh) -> Vec4 {
    let xyz = light.truncate().as_dvec3();
    if light.w == 0.0 {
        return direction(xyz).unwrap_or(light);
    }
    let (low, high) = mesh.bounds();
    let [low, high] = [low, high].map(Vec3::as_dvec3);
    let from_middle = xyz - (low + high) / 2.0;
    let radius = (high - low).length() / 2.0;
    let is_far = radius > 0.0 && from_middle.is_finite() && from_middle.length() > FAR * radius;
    let as_direction = if is_far { direction(from_middle) } else { None };
    as_direction.unwrap_or_else(|| canonical(light.truncate()).extend(light.w))
}

/// Its largest coordinate is 1, so that doing this twice changes nothing.
fn direction(xyz: DVec3) -> Option<Vec4> {
    let largest = xyz.abs().max_element();
    let is_one = largest > 0.0 && largest.is_finite();
    is_one.then(|| canonical((xyz / largest).as_vec3()).extend(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Part;
    use proptest::prelude::*;

    fn triangle(size: f32) -> Mesh {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * size);
        [Part::of_triangles("", &[corners])].into_iter().collect()
    }

    #[test]
    fn what_is_no_light_is_refused() {
        assert_eq!(light(DVec3::ZERO, 0.0), Err(LightError::NoDirection));
        assert_eq!(light(DVec3::NAN, 1.0), Err(LightError::NotFinite));
        assert_eq!(light(DVec3::INFINITY, 0.0), Err(LightError::NotFinite));
        assert_eq!(light(DVec3::splat(1e39), 1.0), Err(LightError::TooFar));
        assert_eq!(light(DVec3::ONE, 0.5), Err(LightError::Weight(0.5)));
        assert_eq!(light(DVec3::ZERO, 1.0), Ok(Vec4::W));
    }

    #[test]
    fn a_light_beyond_what_a_scene_can_tell_is_a_direction() {
        for size in [1e-3, 1.0, 1e6] {
            let towards =
                |distance: f32| Vec4::new(0.3, 1.0, -0.2, 0.0) * distance * size + Vec4::W;
            let placed = |distance| of_scene(towards(distance), &triangle(size));
            assert_eq!(placed(1e7), towards(1e7));
            for distance in [1e9, 1e20, 1e30] {
                let expected = Vec3::new(0.3, 1.0, -0.2);
                let found = placed(distance);
                assert_eq!(found.w, 0.0);
                assert!((found.truncate() - expected).length() < 1e-6, "{found}");
            }
        }
        // Without a size nothing is far.
        assert_eq!(of_scene(Vec4::ONE, &Mesh::default()), Vec4::ONE);
    }

    proptest! {
        #[test]
        fn the_length_of_a_direction_does_not_matter(
            xyz in prop::array::uniform3(-1.0f64..1.0).prop_map(DVec3::from_array),
            exponent in -300i32..300,
        ) {
            prop_assume!(xyz.length() > 0.01);
            let one = light(xyz, 0.0).unwrap();
            prop_assert_eq!(light(xyz * 10f64.powi(exponent), 0.0).unwrap(), one);
            prop_assert_eq!(light(one.truncate().as_dvec3(), 0.0).unwrap(), one);
            prop_assert_eq!(of_scene(one, &triangle(1.0)), one);
            let cosine = one.truncate().as_dvec3().normalize().dot(xyz.normalize());
            prop_assert!(cosine > 1.0 - 1e-13);
        }
    }
}
