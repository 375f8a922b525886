//! Where the light is: at a point, or in a direction whose length means nothing.

use glam::{DVec3, Vec3, Vec4};

use super::mesh::canonical;

/// A light at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// A position with w = 1, or with w = 0 the direction *towards* the light.
    ///
    /// That of a scene is canonical: the largest coordinate of a direction is 1, and a position too far away to
    /// tell from a direction is one.
    pub place: Vec4,
    /// Radius of the ball that shines; of a light at infinity, the tangent of half the angle under which it is
    /// seen. All lights are points, of radius 0, as long as nothing draws or traces soft shadows.
    pub radius: f32,
}

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
    /// There are no keys.
    #[error("a light path needs at least one key")]
    NoKeys,
    /// The times of the keys do not begin at 0 or do not increase.
    #[error("the times of the light's keys must begin at 0 and increase")]
    KeyTimes,
    /// A position that 32 bits do not hold.
    #[error(
        "the light is too far away for 32-bit numbers; give the direction towards it, with w = 0"
    )]
    TooFar,
}

impl Light {
    /// A point light.
    #[must_use]
    pub const fn at(place: Vec4) -> Self {
        Self { place, radius: 0.0 }
    }

    /// A point light as a user writes it: with w = 1 a position, with w = 0 the direction towards it, of any
    /// length.
    ///
    /// # Errors
    /// When there is no such light.
    pub fn new(xyz: DVec3, w: f64) -> Result<Self, LightError> {
        if !xyz.is_finite() {
            return Err(LightError::NotFinite);
        }
        let place = match w {
            0.0 => direction(xyz).ok_or(LightError::NoDirection)?,
            1.0 if xyz.as_vec3().is_finite() => canonical(xyz.as_vec3()),
            1.0 => return Err(LightError::TooFar),
            _ => return Err(LightError::Weight(w)),
        };
        Ok(Self::at(place.extend(w as f32)))
    }

    /// Says why there is no such light, if so.
    ///
    /// # Errors
    /// When there is none.
    pub fn validate(&self) -> Result<(), LightError> {
        Self::new(self.place.truncate().as_dvec3(), f64::from(self.place.w)).map(drop)
    }
}

/// The direction with a largest coordinate of 1, so that doing this twice changes nothing.
pub(super) fn direction(xyz: DVec3) -> Option<Vec3> {
    let largest = xyz.abs().max_element();
    let is_one = largest > 0.0 && largest.is_finite();
    is_one.then(|| canonical((xyz / largest).as_vec3()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn what_is_no_light_is_refused() {
        let light = Light::new;
        assert_eq!(light(DVec3::ZERO, 0.0), Err(LightError::NoDirection));
        assert_eq!(light(DVec3::NAN, 1.0), Err(LightError::NotFinite));
        assert_eq!(light(DVec3::INFINITY, 0.0), Err(LightError::NotFinite));
        assert_eq!(light(DVec3::splat(1e39), 1.0), Err(LightError::TooFar));
        assert_eq!(light(DVec3::ONE, 0.5), Err(LightError::Weight(0.5)));
        assert_eq!(light(DVec3::ZERO, 1.0), Ok(Light::at(Vec4::W)));
        assert_eq!(Light::at(Vec4::ONE).validate(), Ok(()));
        assert_eq!(
            Light::at(Vec4::ZERO).validate(),
            Err(LightError::NoDirection)
        );
    }

    proptest! {
        #[test]
        fn the_length_of_a_direction_does_not_matter(
            xyz in prop::array::uniform3(-1.0f64..1.0).prop_map(DVec3::from_array),
            exponent in -300i32..300,
        ) {
            prop_assume!(xyz.length() > 0.01);
            let one = Light::new(xyz, 0.0).unwrap();
            prop_assert_eq!(Light::new(xyz * 10f64.powi(exponent), 0.0).unwrap(), one);
            let towards = one.place.truncate().as_dvec3();
            prop_assert_eq!(Light::new(towards, 0.0).unwrap(), one);
            let cosine = towards.normalize().dot(xyz.normalize());
            prop_assert!(cosine > 1.0 - 1e-13);
        }
    }
}
