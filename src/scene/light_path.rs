//! Where the light is in time: on a path through keys, or where the sun stands.

use super::light::Light;
use super::light_keys::{LightKeys, LightKeysError};
use super::mesh::Mesh;
use super::sun::Sun;

/// The way of a light.
#[derive(Clone, Debug, PartialEq)]
pub enum LightPath {
    /// Through keys, as a camera flies through its own; one key is a light that stands still.
    Keys(LightKeys),
    /// The sun's, computed anew at each time.
    Sun(Box<Sun>),
}

impl From<LightKeys> for LightPath {
    fn from(keys: LightKeys) -> Self {
        Self::Keys(keys)
    }
}

impl LightPath {
    /// A light that stands still.
    #[must_use]
    pub fn still(light: Light) -> Self {
        Self::Keys(LightKeys::still(light))
    }

    /// How long the path takes.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        match self {
            Self::Keys(keys) => keys.duration_s(),
            Self::Sun(sun) => sun.duration_s(),
        }
    }

    /// The light at a time; before the start it is the first, and after the end the last.
    ///
    /// # Panics
    /// If there are no keys, which [`validate`](Self::validate) reports.
    #[must_use]
    pub fn light_at(&self, time_s: f64) -> Light {
        match self {
            Self::Keys(keys) => keys.light_at(time_s),
            Self::Sun(sun) => sun.light_at(time_s),
        }
    }

    /// The light, if it stands still.
    #[must_use]
    pub fn standing_still(&self) -> Option<Light> {
        match self {
            Self::Keys(keys) => keys.standing_still(),
            Self::Sun(_) => None,
        }
    }

    /// Says what is wrong with the path, if anything; see [`LightKeys::validate`].
    ///
    /// # Errors
    /// When something is.
    pub fn validate(&self) -> Result<(), LightKeysError> {
        match self {
            Self::Keys(keys) => keys.validate(),
            Self::Sun(_) => Ok(()),
        }
    }

    /// The path as a scene with this mesh has it, see [`LightKeys::of_scene`].
    pub(super) fn of_scene(self, mesh: &Mesh) -> Self {
        match self {
            Self::Keys(keys) => Self::Keys(keys.of_scene(mesh)),
            Self::Sun(sun) => Self::Sun(sun),
        }
    }
}
