//! The rays through the pixels of a picture, in f64, from the very matrix that the GPU used.

use glam::{DMat4, DVec2, DVec3, DVec4, Mat4};

use super::ReferenceError;

/// The view that a picture was drawn from.
///
/// The matrix alone says where the eye is; a separate eye could only disagree with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceView {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// World to clip space, the very f32 values that the GPU got: a perspective, y up in clip
    /// space, reversed infinite depth (clip z is the near distance, clip w the depth in view
    /// space).
    pub view_projection: Mat4,
}

impl ReferenceView {
    /// Width times height.
    #[must_use]
    pub fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// A ray from the eye; the direction has length 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct EyeRay {
    pub(super) eye: DVec3,
    pub(super) direction: DVec3,
}

/// The f64 twin of a view: pixels to rays, and points to pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    to_clip: DMat4,
    from_clip: DMat4,
    /// The point that the matrix projects from.
    pub(super) eye: DVec3,
    pub(super) size_px: DVec2,
}

impl Projection {
    pub(super) fn new(view: &ReferenceView) -> Result<Self, ReferenceError> {
        let to_clip = view.view_projection.as_dmat4();
        let from_clip = to_clip.inverse();
        // The eye is the one point whose clip x, y and w are all zero.
        let eye = from_clip.z_axis;
        let eye = eye.truncate() / eye.w;
        if !from_clip.is_finite() || !eye.is_finite() {
            return Err(ReferenceError::BadMatrix);
        }
        let size_px = DVec2::new(f64::from(view.width), f64::from(view.height));
        Ok(Self {
            to_clip,
            from_clip,
            eye,
            size_px,
        })
    }

    /// The ray through a place in the picture, in pixels from its top left corner: the centre of
    /// pixel (0, 0) is (0.5, 0.5).
    pub(super) fn ray(&self, place_px: DVec2) -> EyeRay {
        let ndc = place_px / self.size_px * 2.0 - 1.0;
        // Clip z = 0 is infinitely far, so that the homogeneous point is the direction itself and
        // nothing cancels; the term with w is zero then, and keeps other depth mappings right.
        let far = self.from_clip * DVec4::new(ndc.x, -ndc.y, 0.0, 1.0);
        let direction = (far.truncate() - far.w * self.eye).normalize();
        EyeRay {
            eye: self.eye,
            direction,
        }
    }

    /// Where a point appears, in pixels from the top left corner; `None` behind the eye.
    pub(super) fn place_px(&self, point: DVec3) -> Option<DVec2> {
        let clip = self.to_clip * point.extend(1.0);
        (clip.w > 0.0).then(|| {
            let ndc = DVec2::new(clip.x, -clip.y) / clip.w;
            (ndc + 1.0) * 0.5 * self.size_px
        })
    }

    /// The direction, of length 1, of the picture of a line through a place in the picture (pixels
    /// from the top left corner) and a homogeneous point; `None` where the two coincide.
    ///
    /// It also holds for a point behind the eye or at infinity: lines through it appear as lines
    /// through its projection wherever that falls, or as parallels where it falls nowhere.
    pub(super) fn line_through(&self, point: DVec4, place_px: DVec2) -> Option<DVec2> {
        let clip = self.to_clip * point;
        let scaled_px = 0.5 * (DVec2::new(clip.x, -clip.y) + clip.w) * self.size_px;
        (scaled_px - clip.w * place_px).try_normalize()
    }

    /// Whether the near plane leaves a point in the picture.
    pub(super) fn beyond_near_plane(&self, point: DVec3) -> bool {
        let clip = self.to_clip * point.extend(1.0);
        clip.z <= clip.w
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use glam::camera::rh::proj::directx::{orthographic, perspective_infinite_reverse};
    use glam::camera::rh::view::look_at_mat4;

    fn projection() -> Projection {
        let eye = Vec3::new(3.0, 2.0, 7.0);
        let view_projection = perspective_infinite_reverse(0.8, 4.0 / 3.0, 0.1)
            * look_at_mat4(eye, Vec3::new(0.0, 1.0, 0.0), Vec3::Y);
        Projection::new(&ReferenceView {
            width: 64,
            height: 48,
            view_projection,
        })
        .unwrap()
    }

    #[test]
    fn the_eye_comes_from_the_matrix() {
        assert!(projection().eye.distance(DVec3::new(3.0, 2.0, 7.0)) < 1e-5);
    }

    #[test]
    fn a_ray_and_its_projection_agree() {
        let projection = projection();
        for place in [
            DVec2::new(0.5, 0.5),
            DVec2::new(63.5, 0.5),
            DVec2::new(20.25, 40.75),
        ] {
            let ray = projection.ray(place);
            let seen = projection.place_px(ray.eye + 12.5 * ray.direction).unwrap();
            assert!(seen.distance(place) < 1e-9, "{seen} should be {place}");
            assert!(projection.place_px(ray.eye - ray.direction).is_none());
        }
    }

    #[test]
    fn row_zero_is_at_the_top() {
        let projection = projection();
        let top = projection.ray(DVec2::new(32.0, 0.5)).direction;
        let bottom = projection.ray(DVec2::new(32.0, 47.5)).direction;
        assert!(top.y > bottom.y);
    }

    #[test]
    fn the_near_plane_cuts() {
        let projection = projection();
        let ray = projection.ray(DVec2::new(32.0, 24.0));
        assert!(!projection.beyond_near_plane(ray.eye + 0.099 * ray.direction));
        assert!(projection.beyond_near_plane(ray.eye + 0.101 * ray.direction));
    }

    #[test]
    fn a_parallel_projection_is_refused() {
        let view_projection = orthographic(-1.0, 1.0, -1.0, 1.0, 0.1, 10.0);
        let view = ReferenceView {
            width: 4,
            height: 4,
            view_projection,
        };
        assert_eq!(
            Projection::new(&view).unwrap_err(),
            ReferenceError::BadMatrix
        );
        let view = ReferenceView {
            view_projection: Mat4::ZERO,
            ..view
        };
        assert_eq!(
            Projection::new(&view).unwrap_err(),
            ReferenceError::BadMatrix
        );
    }
}
