//! From the TOML that a user writes to a validated plan of what to measure.

pub(crate) mod method_tables;
pub(crate) mod misplaced;
mod overrides;
pub(crate) mod run_file;
mod scene_lookup;
mod sweep;

pub use overrides::Overrides;
pub use scene_lookup::{builtin_scenes, find_scene};

use crate::methods::ShadowMethod;
use crate::scene::{Flight, ModelSearch, SceneFile};
use crate::variant::Variant;
use std::time::Duration;

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
    /// Width and height of its pictures, where they are not those of the run.
    pub size_px: Option<(u32, u32)>,
}

/// A method to measure.
pub struct MethodPlan {
    /// The method with its parameters.
    pub method: Box<dyn ShadowMethod>,
    /// The curve that it is a point of, if a list of values made it.
    pub sweep: Option<Sweep>,
}

/// A point of a curve: one of the values that a configuration lists for a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Variant of the method without the swept parameter: with the id, the curve's name.
    pub curve: Variant,
    /// The swept parameter.
    pub parameter: String,
    /// Its value here.
    pub value: f64,
}

/// Which frames of a cell are compared with the truth, and how thoroughly.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Verification {
    /// Which frames.
    pub frames: VerifiedFrames,
    /// Whether each is followed by the frame after it, to see what flickers.
    pub flicker: bool,
    /// Whether the shaded pictures are compared too.
    pub flip: bool,
}

/// Which frames of a flight are compared with the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VerifiedFrames {
    /// So many, evenly spaced, each in the middle of its part of the flight, so that no two scenes are
    /// only seen at the flight's ends.
    Spread(u32),
    /// Every Nth measured frame, starting with the first.
    Every(u32),
}

/// What to measure: the matrix of scenes × methods.
pub struct RunPlan {
    /// What the run is about.
    pub title: String,
    /// Width and height of the pictures of scenes that have none of their own.
    pub size_px: (u32, u32),
    /// Frames measured in each cell, evenly spaced along the flight.
    pub frames: u32,
    /// Frames of each cell drawn before measuring.
    pub warmup_frames: u32,
    /// Frames drawn before each measured and each verified one, one of 60 a second.
    pub lead_in: u32,
    /// How long the run may work on one cell; `None` for as long as it takes.
    pub cell_timeout: Option<Duration>,
    /// What of each cell is compared with the truth.
    pub verification: Verification,
    /// Seed of the order in which methods are measured.
    pub seed: u64,
    /// The scenes, in order.
    pub scenes: Vec<ScenePlan>,
    /// The methods, in order.
    pub methods: Vec<MethodPlan>,
    /// The configuration file as named by the user.
    pub path: String,
    /// Its text.
    pub text: String,
    /// The scale that was chosen; `full` for the configuration's own numbers.
    pub scale: String,
}

/// Views at which a run that verifies nothing tries biases.
const BIAS_VIEWS: usize = 3;

impl RunPlan {
    /// Width and height of a scene's pictures.
    pub fn size_of(&self, scene: &ScenePlan) -> (u32, u32) {
        scene.size_px.unwrap_or(self.size_px)
    }

    /// Frames drawn for one cell.
    pub fn steps_per_cell(&self) -> u64 {
        u64::from(self.warmup_frames) + u64::from(self.frames) + u64::from(self.verified_frames())
    }

    /// Frames drawn for one scene.
    pub fn steps_per_scene(&self) -> u64 {
        self.steps_per_cell() * self.methods.len() as u64
    }

    /// Frames of each cell compared with the truth.
    pub fn verified_frames(&self) -> u32 {
        match self.verification.frames {
            VerifiedFrames::Spread(count) => count,
            VerifiedFrames::Every(step) => self.frames.div_ceil(step),
        }
    }

    /// When on the flight biases are tried: midway between the verified frames, lest a map be fitted to the very
    /// frames that it is judged by.
    pub fn bias_times(&self, flight: &Flight) -> Vec<f64> {
        let mut verified_s = self.verified_times(flight);
        if verified_s.is_empty() {
            verified_s = flight.frame_times(BIAS_VIEWS);
        }
        let next_s = verified_s.iter().skip(1).copied();
        let next_s = next_s.chain([flight.duration_s()]);
        let pairs = verified_s.iter().zip(next_s);
        pairs.map(|(a, b)| (a + b) / 2.0).collect()
    }

    /// When on the flight the frames are that are compared with the truth.
    pub fn verified_times(&self, flight: &Flight) -> Vec<f64> {
        match self.verification.frames {
            VerifiedFrames::Spread(count) => (0..count)
                .map(|i| flight.duration_s() * (f64::from(i) + 0.5) / f64::from(count))
                .collect(),
            VerifiedFrames::Every(step) => {
                let measured = flight.frame_times(self.frames as usize);
                measured.into_iter().step_by(step as usize).collect()
            }
        }
    }
}
