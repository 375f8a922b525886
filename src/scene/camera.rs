//! Where the picture is taken from: a view, and a path of views over time.

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
