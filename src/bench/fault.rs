//! How far a failure reaches. What concerns a cell is its status; what concerns a scene ends that scene; only
//! a run directory that cannot be written ends a run.

use crate::record::RunDirError;

/// Why a scene does not go on.
pub(super) enum Broken {
    /// The scene itself, and with it all its cells.
    Scene(anyhow::Error),
    /// The run, and with it everything.
    Run(RunDirError),
}

impl From<anyhow::Error> for Broken {
    fn from(error: anyhow::Error) -> Self {
        Self::Scene(error)
    }
}

impl From<RunDirError> for Broken {
    fn from(error: RunDirError) -> Self {
        Self::Run(error)
    }
}
