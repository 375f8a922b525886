//! What the command line changes in a configuration.

use super::{ConfigError, RunPlan, Verification, VerifiedFrames};
use crate::methods::Registry;

/// Values that replace the configuration's.
#[derive(Debug, Clone, Default)]
pub struct Overrides {
    /// Picture width and height.
    pub size_px: Option<(u32, u32)>,
    /// Measured frames.
    pub frames: Option<u32>,
    /// Compare every Nth measured frame with the truth, and see what flickers and what the
    /// shaded pictures look like.
    pub accuracy: Option<u32>,
    /// Run only these methods; empty for all.
    pub only: Vec<String>,
}

impl Overrides {
    /// Applies them to a plan of methods from `registry`.
    ///
    /// # Errors
    /// When `only` names a method that does not exist or that the plan does not have.
    pub fn apply(&self, plan: &mut RunPlan, registry: &Registry) -> Result<(), ConfigError> {
        if let Some(size_px) = self.size_px {
            plan.size_px = size_px;
        }
        if let Some(frames) = self.frames {
            plan.frames = frames;
        }
        if let Some(every) = self.accuracy {
            plan.verification = Verification {
                frames: VerifiedFrames::Every(every),
                flicker: true,
                flip: true,
            };
        }
        for id in &self.only {
            if let Err(unknown) = registry.get(id) {
                return Err(ConfigError(format!("--only: {unknown}")));
            }
            if !plan.methods.iter().any(|plan| plan.method.info().id == id) {
                return Err(ConfigError(format!(
                    "--only: {} does not run `{id}`",
                    plan.path
                )));
            }
        }
        if !self.only.is_empty() {
            plan.methods
                .retain(|plan| self.only.iter().any(|id| id == plan.method.info().id));
        }
        super::run_file::check_counts(plan).map_err(ConfigError)
    }
}
