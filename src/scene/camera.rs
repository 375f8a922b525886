//! Where the pictures are taken from: views through keys in time.

use glam::Vec3;

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

/// Why a frame of a flight has no picture.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no picture at {time_s} s of the flight: {problem}")]
pub struct FrameError {
    /// When on the flight.
    pub time_s: f64,
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

/// A smooth flight through keys.
///
/// Eye and target follow a Catmull-Rom spline whose knots are the times of the keys: it passes
/// through each key at its time, and its velocity has no jumps. Two keys make a straight line,
/// one makes a still picture.
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
        let keys = vec![CameraKey {
            time_s: 0.0,
            eye,
            target: centre,
        }];
        Self {
            keys,
            up: Vec3::Y,
            fov_y_rad,
            near: 0.01 * radius,
        }
    }

    /// How long the flight takes.
    pub fn duration_s(&self) -> f64 {
        self.keys.last().map_or(0.0, |key| key.time_s)
    }

    /// The times of `count` frames, evenly spaced from start to end; one frame is the start.
    pub fn frame_times(&self, count: usize) -> Vec<f64> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count)
            .map(|frame| self.duration_s() * (frame as f64 / last))
            .collect()
    }

    /// The view at a time; before the start it is the first, and after the end the last.
    ///
    /// # Panics
    ///
    /// If there are no keys, which [`validate`](Self::validate) reports.
    pub fn view_at(&self, time_s: f64) -> View {
        let time_s = time_s.clamp(0.0, self.duration_s());
        let after = self.keys.partition_point(|key| key.time_s <= time_s);
        let i = after.saturating_sub(1);
        let (eye, target) = match self.keys.get(i + 1) {
            None => (self.keys[i].eye, self.keys[i].target),
            Some(next) => {
                let key = self.keys[i];
                let s = (time_s - key.time_s) / (next.time_s - key.time_s);
                (
                    self.interpolate(i, s, |key| key.eye),
                    self.interpolate(i, s, |key| key.target),
                )
            }
        };
        View {
            eye,
            target,
            up: self.up,
            fov_y_rad: self.fov_y_rad,
            near: self.near,
        }
    }

    /// The cubic between keys `i` and `i + 1` at `s` from 0 to 1, by Hermite's basis.
    fn interpolate(&self, i: usize, s: f64, of: impl Fn(&CameraKey) -> Vec3) -> Vec3 {
        let duration_s = self.keys[i + 1].time_s - self.keys[i].time_s;
        let [m0, m1] = [i, i + 1].map(|k| self.velocity(k, &of) * duration_s as f32);
        let [p0, p1] = [i, i + 1].map(|k| of(&self.keys[k]));
        let (s1, s2, s3) = (s as f32, (s * s) as f32, (s * s * s) as f32);
        let blend = 3.0 * s2 - 2.0 * s3;
        p0 + (p1 - p0) * blend + m0 * (s3 - 2.0 * s2 + s1) + m1 * (s3 - s2)
    }

    /// Units a second at key `i`: the slope there of the parabola through the key and its two
    /// neighbours; at an end, of the line to the only neighbour.
    fn velocity(&self, i: usize, of: impl Fn(&CameraKey) -> Vec3) -> Vec3 {
        let slope = |from: usize, to: usize| {
            let (from, to) = (&self.keys[from], &self.keys[to]);
            let duration_s = to.time_s - from.time_s;
            ((of(to) - of(from)) / duration_s as f32, duration_s)
        };
        if i == 0 {
            return slope(0, 1).0;
        }
        let (before, before_s) = slope(i - 1, i);
        if i + 1 == self.keys.len() {
            return before;
        }
        let (after, after_s) = slope(i, i + 1);
        // The shorter side weighs more.
        before.lerp(after, (before_s / (before_s + after_s)) as f32)
    }

    /// The first of some times on the flight at which there is no picture, and why.
    ///
    /// # Errors
    /// When there is one.
    pub fn check_times(&self, mut times_s: impl Iterator<Item = f64>) -> Result<(), FrameError> {
        times_s.try_for_each(|time_s| {
            let checked = self.view_at(time_s).validate();
            checked.map_err(|problem| FrameError { time_s, problem })
        })
    }

    /// Says what is wrong with the keys, if anything. Between good keys the flight may still pass
    /// through its own target: [`View::validate`] says so for one view.
    pub fn validate(&self) -> Result<(), CameraPathError> {
        let at_key = |key| move |problem| CameraPathError { key, problem };
        if self.keys.is_empty() {
            return Err(at_key(None)(CameraError::NoKeys));
        }
        let mut earliest_s = 0.0;
        for (i, key) in self.keys.iter().enumerate() {
            let in_order = if i == 0 {
                key.time_s == 0.0
            } else {
                key.time_s > earliest_s
            };
            if !in_order || !key.time_s.is_finite() {
                return Err(at_key(Some(i))(CameraError::KeyTimes));
            }
            // The views below also depend on the neighbours of a key, and would blame one of them.
            if !key.eye.is_finite() || !key.target.is_finite() {
                return Err(at_key(Some(i))(CameraError::NotFinite));
            }
            earliest_s = key.time_s;
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
