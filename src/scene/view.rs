//! What a camera sees from one place, and its matrices.

use glam::{Mat4, Vec3, Vec4};

/// A camera at one moment. World space is right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the camera is.
    pub eye: Vec3,
    /// The point in the middle of the picture.
    pub target: Vec3,
    /// Which way is up; need not be of unit length or perpendicular to the line of sight.
    pub up: Vec3,
    /// The opening angle from the bottom to the top of the picture.
    pub fov_y_rad: f32,
    /// Distance of the near plane; the far plane is at infinity.
    pub near: f32,
}

/// Degrees as the nearest radians. Every number of radians has degrees that give it; with degrees of 32
/// bits, some had none.
pub fn radians(degrees: f64) -> f32 {
    degrees.to_radians() as f32
}

/// A direction with another length, the largest coordinate from 1 to 2: squares then neither overflow nor
/// vanish. It is scaled by a power of two, so that no later step rounds otherwise.
fn of_size_one(direction: Vec3) -> Vec3 {
    let largest = f64::from(direction.abs().max_element());
    if largest == 0.0 || !largest.is_finite() {
        return direction;
    }
    let scale = 2f64.powi(-largest.log2().floor() as i32);
    (direction.as_dvec3() * scale).as_vec3()
}

/// Why there is no picture from a camera.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// A number is NaN or infinite.
    #[error("a camera needs finite numbers")]
    NotFinite,
    /// The numbers are finite, and what is computed of them is not.
    #[error("the camera's numbers are too large or too small to make a picture with")]
    TooExtreme,
    /// The eye and the target are the same point.
    #[error("the camera looks at the point where it is: move its eye or its target")]
    NoDirection,
    /// Up is zero or along the line of sight.
    #[error(
        "the camera looks along its up direction: give another `up`, or move the target a little"
    )]
    NoUp,
    /// The opening angle cannot be.
    #[error("the field of view must be above 0 and below 180 degrees")]
    FieldOfView,
    /// The near plane is not in front.
    #[error("the near plane must be farther away than 0")]
    Near,
    /// There are no keys.
    #[error("a camera path needs at least one key")]
    NoKeys,
    /// The times of the keys do not begin at 0 or do not increase.
    #[error("the times of the camera's keys must begin at 0 and increase")]
    KeyTimes,
}

impl View {
    /// View space to clip space, for a picture `aspect` times as wide as high.
    ///
    /// Depth is **reversed**, 1 at the near plane and 0 at infinity: clip z is `near` for every
    /// point, and w is -z of view space.
    pub fn projection(&self, aspect: f32) -> Mat4 {
        let rows = self.clip_rows(aspect, [Vec4::X, Vec4::Y, Vec4::Z]);
        Mat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose()
    }

    /// World space to clip space. The row that makes z is exactly (0, 0, 0, `near`): the matrix is
    /// composed of rows instead of multiplied, and nothing is rounded there.
    pub fn view_projection(&self, aspect: f32) -> Mat4 {
        let backward = of_size_one(self.eye - self.target).normalize();
        let right = of_size_one(self.up).cross(backward).normalize();
        let up = backward.cross(right);
        let view_rows = [right, up, backward].map(|axis| axis.extend(-axis.dot(self.eye)));
        let rows = self.clip_rows(aspect, view_rows);
        Mat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose()
    }

    /// The rows of projection × view, from the rows of view that make x, y and z.
    fn clip_rows(&self, aspect: f32, [x, y, z]: [Vec4; 3]) -> [Vec4; 4] {
        let scale_y = 1.0 / (0.5 * self.fov_y_rad).tan();
        [
            x * (scale_y / aspect),
            y * scale_y,
            Vec4::new(0.0, 0.0, 0.0, self.near),
            -z,
        ]
    }

    /// Says why there is no picture from here, if so.
    pub fn validate(&self) -> Result<(), CameraError> {
        let Self {
            eye,
            target,
            up,
            fov_y_rad,
            near,
        } = *self;
        if ![eye, target, up].iter().all(|v| v.is_finite())
            || !fov_y_rad.is_finite()
            || !near.is_finite()
        {
            return Err(CameraError::NotFinite);
        }
        if fov_y_rad <= 0.0 || fov_y_rad >= std::f32::consts::PI {
            return Err(CameraError::FieldOfView);
        }
        if near <= 0.0 {
            return Err(CameraError::Near);
        }
        if target == eye {
            return Err(CameraError::NoDirection);
        }
        let forward = of_size_one(target - eye)
            .try_normalize()
            .ok_or(CameraError::TooExtreme)?;
        let up = of_size_one(up).try_normalize().ok_or(CameraError::NoUp)?;
        // Closer than this, rounding decides where right is.
        const SMALLEST_SINE: f32 = 1e-4;
        if forward.cross(up).length() < SMALLEST_SINE {
            return Err(CameraError::NoUp);
        }
        if !self.view_projection(1.0).is_finite() {
            return Err(CameraError::TooExtreme);
        }
        Ok(())
    }
}

#[cfg(test)]
#[path = "view_tests.rs"]
mod tests;
