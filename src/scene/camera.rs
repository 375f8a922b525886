//! Where the pictures are taken from: views through keys in time.

use glam::Vec3;

use super::spline::{self, Key};
use super::view::{CameraError, View};

/// What is wrong with a camera path.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{problem}")]
pub struct CameraPathError {
    /// The key at fault, if it is one of them.
    pub key: Option<usize>,
    /// What is wrong there.
    pub problem: CameraError,
}

/// Where the camera is at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraKey {
    /// When, from the start of the path.
    pub time_s: f64,
    /// Where the camera is.
    pub eye: Vec3,
    /// What it looks at.
    pub target: Vec3,
}

impl Key for CameraKey {
    fn time_s(&self) -> f64 {
        self.time_s
    }
}

/// A smooth flight through keys: eye and target follow a Catmull-Rom spline. One key makes a still picture.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    /// At least one key; times begin at 0 and increase.
    pub keys: Vec<CameraKey>,
    /// Which way is up, all the way.
    pub up: Vec3,
    /// The opening angle from the bottom to the top of the picture.
    pub fov_y_rad: f32,
    /// Distance of the near plane.
    pub near: f32,
}

impl CameraPath {
    /// A still that shows the whole of a box, from the front, the right and above.
    pub fn framing(low: Vec3, high: Vec3) -> Self {
        let fov_y_rad = 45f32.to_radians();
        let centre = low + (high - low) / 2.0;
        let radius = ((high - low) / 2.0).length();
        let radius = if radius > 0.0 { radius } else { 1.0 };
        // The cone of view touches the sphere around the box.
        let distance = radius / (fov_y_rad / 2.0).sin();
        let eye = centre + distance * Vec3::new(1.0, 0.8, 1.6).normalize();
        Self::still(&View {
            eye,
            target: centre,
            up: Vec3::Y,
            fov_y_rad,
            near: 0.01 * radius,
        })
    }

    /// The same path where lengths so far were in radii of the sphere around a box, and places counted from its middle.
    #[must_use]
    pub fn around(mut self, low: Vec3, high: Vec3) -> Self {
        let centre = low + (high - low) / 2.0;
        let radius = ((high - low) / 2.0).length();
        for key in &mut self.keys {
            key.eye = centre + radius * key.eye;
            key.target = centre + radius * key.target;
        }
        self.near *= radius;
        self
    }

    /// A camera that does not move.
    #[must_use]
    pub fn still(view: &View) -> Self {
        let View {
            eye,
            target,
            up,
            fov_y_rad,
            near,
        } = *view;
        let time_s = 0.0;
        Self {
            keys: vec![CameraKey {
                time_s,
                eye,
                target,
            }],
            up,
            fov_y_rad,
            near,
        }
    }

    /// How long the flight takes.
    pub fn duration_s(&self) -> f64 {
        spline::duration_s(&self.keys)
    }

    /// The view at a time; before the start it is the first, and after the end the last.
    ///
    /// # Panics
    ///
    /// If there are no keys, which [`validate`](Self::validate) reports.
    pub fn view_at(&self, time_s: f64) -> View {
        View {
            eye: spline::sample(&self.keys, time_s, |key| key.eye),
            target: spline::sample(&self.keys, time_s, |key| key.target),
            up: self.up,
            fov_y_rad: self.fov_y_rad,
            near: self.near,
        }
    }

    /// Says what is wrong with the keys, if anything. Between good keys the flight may still pass
    /// through its own target: [`View::validate`] says so for one view.
    pub fn validate(&self) -> Result<(), CameraPathError> {
        let at_key = |key| move |problem| CameraPathError { key, problem };
        if self.keys.is_empty() {
            return Err(at_key(None)(CameraError::NoKeys));
        }
        if let Some(key) = spline::out_of_order(&self.keys) {
            return Err(at_key(Some(key))(CameraError::KeyTimes));
        }
        // The views below also depend on the neighbours of a key, and would blame one of them.
        let is_finite = |key: &CameraKey| key.eye.is_finite() && key.target.is_finite();
        if let Some(key) = self.keys.iter().position(|key| !is_finite(key)) {
            return Err(at_key(Some(key))(CameraError::NotFinite));
        }
        for (i, key) in self.keys.iter().enumerate() {
            self.view_at(key.time_s)
                .validate()
                .map_err(at_key(Some(i)))?;
        }
        Ok(())
    }
}

#[cfg(test)]
#[path = "camera_tests.rs"]
mod tests;
