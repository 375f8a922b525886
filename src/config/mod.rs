//! From the TOML that a user writes to a validated plan of what to measure.

mod method_tables;
mod misplaced;
mod overrides;
mod run_file;
mod scene_lookup;

pub use overrides::Overrides;
pub use scene_lookup::{builtin_scenes, find_scene};

use crate::methods::ShadowMethod;
use crate::scene::{CameraPath, ModelSearch, SceneFile};

/// Why a configuration cannot be run. The message names file and place.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ConfigError(pub String);

/// A scene to measure.
pub struct ScenePlan {
    /// The scene as its file describes it.
    pub file: SceneFile,
    /// Where its models are looked for.
    pub search: ModelSearch,
}

/// What to measure: the matrix of scenes × methods at one size.
pub struct RunPlan {
    /// What the run is about.
    pub title: String,
    /// Width and height of the picture.
    pub size_px: (u32, u32),
    /// Frames measured in each cell, evenly spaced along the flight.
    pub frames: u32,
    /// Frames of each cell drawn before measuring.
    pub warmup_frames: u32,
    /// Frames of each cell compared with the truth.
    pub verified_frames: u32,
    /// Seed of the order in which methods are measured.
    pub seed: u64,
    /// The scenes, in order.
    pub scenes: Vec<ScenePlan>,
    /// The methods, in order.
    pub methods: Vec<Box<dyn ShadowMethod>>,
    /// The configuration file as named by the user.
    pub path: String,
    /// Its text.
    pub text: String,
    /// The scale that was chosen; `full` for the configuration's own numbers.
    pub scale: String,
}

impl RunPlan {
    /// Frames drawn for one cell.
    pub fn steps_per_cell(&self) -> u64 {
        u64::from(self.warmup_frames) + u64::from(self.frames) + u64::from(self.verified_frames)
    }

    /// Frames drawn for one scene.
    pub fn steps_per_scene(&self) -> u64 {
        self.steps_per_cell() * self.methods.len() as u64
    }

    /// When on the flight the frames are that are compared with the truth: evenly spaced, each in
    /// the middle of its part, so that no two scenes are only seen at the flight's ends.
    pub fn verified_times(&self, camera: &CameraPath) -> Vec<f64> {
        let count = f64::from(self.verified_frames);
        (0..self.verified_frames)
            .map(|i| camera.duration_s() * (f64::from(i) + 0.5) / count)
            .collect()
    }
}
