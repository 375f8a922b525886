//! A flight: camera and light are one path in time.
//!
//! All that a frame is drawn from besides the mesh is the [`Moment`] of its time. Nothing that is derived from a
//! light may be kept for longer than that.

use super::camera::CameraPath;
use super::light::{Light, LightError};
use super::light_path::LightPath;
use super::view::{CameraError, View};

/// Where the camera and the light are in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight {
    /// Where the pictures are taken from.
    pub camera: CameraPath,
    /// Where the light is.
    pub light: LightPath,
}

/// What one frame is drawn from, besides the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// The camera.
    pub view: View,
    /// The light.
    pub light: Light,
}

/// Why there is no picture of a moment.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MomentError {
    /// The camera sees nothing.
    #[error("camera: {0}")]
    Camera(CameraError),
    /// There is no such light.
    #[error("light: {0}")]
    Light(LightError),
}

/// Why a frame of a flight has no picture.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("no picture at {time_s} s of the flight: {problem}")]
pub struct FrameError {
    /// When on the flight.
    pub time_s: f64,
    /// What is wrong there.
    pub problem: MomentError,
}

impl Moment {
    /// Says why there is no picture of it, if so.
    ///
    /// # Errors
    /// When there is none.
    pub fn validate(&self) -> Result<(), MomentError> {
        self.view.validate().map_err(MomentError::Camera)?;
        self.light.validate().map_err(MomentError::Light)
    }
}

impl Flight {
    /// A flight under a light that stands still.
    #[must_use]
    pub fn under(light: Light, camera: CameraPath) -> Self {
        Self {
            camera,
            light: LightPath::still(light),
        }
    }

    /// Nothing moves.
    #[must_use]
    pub fn still(moment: &Moment) -> Self {
        Self::under(moment.light, CameraPath::still(&moment.view))
    }

    /// How long it takes, until neither camera nor light moves any more.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.camera.duration_s().max(self.light.duration_s())
    }

    /// The times of `count` frames, evenly spaced from start to end; one frame is the start.
    #[must_use]
    pub fn frame_times(&self, count: usize) -> Vec<f64> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count)
            .map(|frame| self.duration_s() * (frame as f64 / last))
            .collect()
    }

    /// Camera and light at a time. Each stays where it was before its start and after its end.
    ///
    /// # Panics
    /// If one of them has no keys.
    #[must_use]
    pub fn at(&self, time_s: f64) -> Moment {
        Moment {
            view: self.camera.view_at(time_s),
            light: self.light.light_at(time_s),
        }
    }

    /// The first of some times at which there is no picture, and why.
    ///
    /// # Errors
    /// When there is one.
    pub fn check_times(&self, mut times_s: impl Iterator<Item = f64>) -> Result<(), FrameError> {
        times_s.try_for_each(|time_s| {
            let checked = self.at(time_s).validate();
            checked.map_err(|problem| FrameError { time_s, problem })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{CameraKey, LightKey, LightKeys};
    use glam::{Vec3, Vec4};

    fn camera(keys: &[(f64, Vec3, Vec3)]) -> CameraPath {
        let key = |&(time_s, eye, target): &(f64, Vec3, Vec3)| CameraKey {
            time_s,
            eye,
            target,
        };
        CameraPath {
            keys: keys.iter().map(key).collect(),
            up: Vec3::Y,
            fov_y_rad: 1.0,
            near: 0.1,
        }
    }

    fn light(keys: &[(f64, Vec3)], w: f32) -> LightPath {
        let key = |&(time_s, place): &(f64, Vec3)| LightKey { time_s, place };
        LightPath::Keys(LightKeys {
            keys: keys.iter().map(key).collect(),
            w,
            radius: 0.0,
        })
    }

    const HERE: Vec3 = Vec3::new(0.0, 1.0, 6.0);

    #[test]
    fn frames_are_evenly_spaced_from_start_to_end() {
        let eyes = [
            (0.0, HERE, Vec3::ZERO),
            (1.0, HERE, Vec3::X),
            (3.0, HERE, Vec3::ZERO),
        ];
        let flight = Flight::under(Light::at(Vec4::Y), camera(&eyes));
        assert_eq!(flight.frame_times(4), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(flight.frame_times(1), [0.0]);
        assert!(flight.frame_times(0).is_empty());
        assert_eq!(flight.frame_times(977)[976], 3.0);
    }

    #[test]
    fn a_flight_lasts_until_nothing_moves() {
        let still = camera(&[(0.0, HERE, Vec3::ZERO)]);
        let moving = camera(&[(0.0, HERE, Vec3::ZERO), (5.0, HERE * 2.0, Vec3::ZERO)]);
        let lamp = light(&[(0.0, Vec3::Y), (2.0, Vec3::Y + Vec3::X)], 1.0);
        let flight = |camera, light| Flight { camera, light };
        let day = flight(still.clone(), lamp.clone());
        assert_eq!(day.frame_times(3), [0.0, 1.0, 2.0]);
        assert_eq!(day.at(1.0).light.place, Vec4::new(0.5, 1.0, 0.0, 1.0));
        assert_eq!(day.at(1.0).view, day.at(0.0).view);
        let long = flight(moving, lamp);
        assert_eq!(long.duration_s(), 5.0);
        assert_eq!(long.at(4.0).light, long.at(2.0).light);
        let stands = Flight::still(&long.at(1.0));
        assert_eq!((stands.duration_s(), stands.at(3.0)), (0.0, long.at(1.0)));
    }

    #[test]
    fn the_first_time_without_a_picture_is_named() {
        let (here, there) = (Vec3::Z * 6.0, Vec3::ZERO);
        let through = camera(&[(0.0, here, there), (2.0, there, here)]);
        assert_eq!(through.validate(), Ok(()), "its keys are good");
        let flight = Flight::under(Light::at(Vec4::Y), through);
        assert_eq!(flight.check_times([0.0, 0.5, 2.0].into_iter()), Ok(()));
        let error = flight.check_times([0.0, 1.0, 2.0].into_iter()).unwrap_err();
        let problem = MomentError::Camera(CameraError::NoDirection);
        assert_eq!(
            error,
            FrameError {
                time_s: 1.0,
                problem
            }
        );

        let over = Flight {
            camera: camera(&[(0.0, HERE, Vec3::ZERO)]),
            light: light(&[(0.0, Vec3::Y), (4.0, Vec3::NEG_Y)], 0.0),
        };
        let error = over.check_times([1.0, 2.0].into_iter()).unwrap_err();
        let text = error.to_string();
        assert!(
            text.contains("at 2 s") && text.contains("towards the light"),
            "{text}"
        );
    }
}
