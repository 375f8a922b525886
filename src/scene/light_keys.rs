//! Where the light is in time: a smooth path through keys, or one place.

use glam::{DVec3, Vec3};

use super::light::{Light, LightError, direction};
use super::mesh::{Mesh, canonical};
use super::spline::{self, Key};

/// A point light farther away than this many radii of the scene is a direction: seen from all of the scene it
/// is in the same place, to the last bit of a coordinate.
const FAR: f64 = (1 << 24) as f64;

/// Where the light is at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightKey {
    /// When, from the start of the path.
    pub time_s: f64,
    /// The position, or the direction towards it.
    pub place: Vec3,
}

impl Key for LightKey {
    fn time_s(&self) -> f64 {
        self.time_s
    }
}

/// The way of a light: through its keys as a camera flies through its own. One key is a light that stands still.
///
/// A light is at a point or at infinity all the way, so a path cannot lead from one to the other.
#[derive(Clone, Debug, PartialEq)]
pub struct LightKeys {
    /// At least one key; times begin at 0 and increase.
    pub keys: Vec<LightKey>,
    /// 1: the keys are positions; 0: they are directions towards the light.
    pub w: f32,
    /// See [`Light::radius`].
    pub radius: f32,
}

/// What is wrong with a light path.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{problem}")]
pub struct LightKeysError {
    /// The key at fault, if it is one of them.
    pub key: Option<usize>,
    /// What is wrong there.
    pub problem: LightError,
}

impl LightKeys {
    /// A light that stands still.
    #[must_use]
    pub fn still(light: Light) -> Self {
        let place = light.place.truncate();
        Self {
            keys: vec![LightKey { time_s: 0.0, place }],
            w: light.place.w,
            radius: light.radius,
        }
    }

    /// How long the path takes.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        spline::duration_s(&self.keys)
    }

    /// The light at a time; before the start it is the first, and after the end the last.
    ///
    /// Directions turn as vectors of one length do. Where the path leads through the origin there is no direction:
    /// [`Light::validate`] says so.
    ///
    /// # Panics
    /// If there are no keys, which [`validate`](Self::validate) reports.
    #[must_use]
    pub fn light_at(&self, time_s: f64) -> Light {
        let time_s = time_s.clamp(0.0, self.duration_s());
        // At a key, not a bit is to be rounded otherwise.
        let place = match self.keys.iter().find(|key| key.time_s == time_s) {
            Some(key) => key.place,
            None if self.w == 0.0 => {
                let turned =
                    spline::sample(&self.keys, time_s, |key| key.place.normalize_or_zero());
                direction(turned.as_dvec3()).unwrap_or(Vec3::ZERO)
            }
            None => canonical(spline::sample(&self.keys, time_s, |key| key.place)),
        };
        Light {
            place: place.extend(self.w),
            radius: self.radius,
        }
    }

    /// The light, if it stands still.
    #[must_use]
    pub fn standing_still(&self) -> Option<Light> {
        let first = self.keys.first()?;
        let is_there = |key: &LightKey| key.place == first.place;
        self.keys.iter().all(is_there).then(|| self.light_at(0.0))
    }

    /// Says what is wrong with the keys, if anything. Between good keys a direction may still vanish:
    /// [`Light::validate`] says so for one moment.
    ///
    /// # Errors
    /// When something is.
    pub fn validate(&self) -> Result<(), LightKeysError> {
        let at_key = |key| move |problem| LightKeysError { key, problem };
        if self.keys.is_empty() {
            return Err(at_key(None)(LightError::NoKeys));
        }
        if let Some(key) = spline::out_of_order(&self.keys) {
            return Err(at_key(Some(key))(LightError::KeyTimes));
        }
        for (i, key) in self.keys.iter().enumerate() {
            let light = Light::at(key.place.extend(self.w));
            light.validate().map_err(at_key(Some(i)))?;
        }
        Ok(())
    }

    /// The path as a scene with this mesh has it: the same for all lengths of directions, and of directions where
    /// every key is too far away to tell from one.
    pub(super) fn of_scene(self, mesh: &Mesh) -> Self {
        let is_directional = self.w == 0.0;
        let (low, high) = mesh.bounds();
        let [low, high] = [low, high].map(Vec3::as_dvec3);
        let radius = (high - low).length() / 2.0;
        let is_far = |from_middle: DVec3| {
            radius > 0.0 && from_middle.is_finite() && from_middle.length() > FAR * radius
        };
        let towards = |key: &LightKey| {
            let xyz = key.place.as_dvec3();
            if is_directional {
                return direction(xyz);
            }
            let from_middle = xyz - (low + high) / 2.0;
            let far = Some(from_middle).filter(|from_middle| is_far(*from_middle));
            far.and_then(direction)
        };
        let directions: Option<Vec<Vec3>> = self.keys.iter().map(towards).collect();
        let (w, places) = match directions {
            Some(directions) => (0.0, directions),
            None => {
                let places = self.keys.iter().map(|key| canonical(key.place));
                (self.w, places.collect())
            }
        };
        let keys = self.keys.iter().zip(places);
        let keys = keys.map(|(&LightKey { time_s, .. }, place)| LightKey { time_s, place });
        Self {
            keys: keys.collect(),
            w,
            ..self
        }
    }
}

#[cfg(test)]
#[path = "light_keys_tests.rs"]
mod tests;
