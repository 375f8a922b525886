//! How much of the light reaches points of a triangle, whoever looks.

use glam::DVec3;

use super::segment::{ExactLight, Segment};
use super::trace::Reference;
use super::{ReferenceError, Visibility};
use crate::scene::Light;

impl Reference {
    /// What reaches points of a triangle, which are given by the weights of its corners. It is lit on the side that
    /// faces the light, whichever that is: of a closed body, the other triangles keep the light from the inner side.
    ///
    /// # Errors
    /// [`ReferenceError::BadLight`], or [`ReferenceError::LightHasSize`].
    ///
    /// # Panics
    /// When there is no such triangle.
    pub fn light_on(
        &self,
        light: Light,
        triangle: u32,
        weights: &[DVec3],
    ) -> Result<Vec<Visibility>, ReferenceError> {
        let light = ExactLight::new(light)?;
        let own = self.tree.primitive(triangle);
        let [a, b, c] = own.corners.map(|corner| corner.as_dvec3());
        let mut last_blocker = None;
        let visibility = |weights: &DVec3| {
            let point = weights.x * a + weights.y * b + weights.z * c;
            let segment = Segment::new(point, light, self.tree.scale);
            self.occlusion(own, &segment, &mut last_blocker)
        };
        Ok(weights.iter().map(visibility).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, Vec4};

    #[test]
    fn a_triangle_is_lit_on_either_side_and_shaded_by_others() {
        let corners = [
            Vec3::ZERO,
            Vec3::new(2.0, 0.0, 0.0),
            Vec3::new(0.0, 0.0, 2.0),
            Vec3::new(-1.0, 1.0, -1.0),
            Vec3::new(2.0, 1.0, -1.0),
            Vec3::new(-1.0, 1.0, 2.0),
        ];
        let reference = Reference::new(&corners, &[[0, 1, 2], [3, 4, 5]], |_| true).unwrap();
        let thirds = DVec3::splat(1.0 / 3.0);
        let near_a = DVec3::new(0.9, 0.05, 0.05);
        let of = |y: f32, triangle| {
            let light = Light::at(Vec4::new(0.0, y, 0.0, 0.0));
            reference
                .light_on(light, triangle, &[near_a, thirds])
                .unwrap()
        };
        use Visibility as V;
        // The plate over it is above the near point, and not above the middle.
        assert_eq!(of(1.0, 0), [V::NONE, V::FULL]);
        assert_eq!(of(-1.0, 0), [V::FULL; 2]);
        assert_eq!(of(1.0, 1), [V::FULL; 2]);
        let no_light = Light::at(Vec4::ZERO);
        assert!(reference.light_on(no_light, 0, &[thirds]).is_err());
    }
}
