//! How far a failure reaches. What concerns a cell is its status; what concerns a scene ends that scene; only
//! a run directory that cannot be written ends a run.

/// The run directory cannot be written: the one error that ends a run.
///
/// It is made by the run directory alone, and no other error becomes one by itself.
#[derive(Debug, thiserror::Error)]
#[error("{0:#}")]
pub(super) struct RunDirError(anyhow::Error);

impl RunDirError {
    pub(super) fn of<T>(result: anyhow::Result<T>) -> Result<T, Self> {
        result.map_err(Self)
    }

    pub(super) fn into_inner(self) -> anyhow::Error {
        self.0
    }
}

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

/// An error and its causes, for a table.
pub(crate) fn in_one_line(error: &anyhow::Error) -> String {
    let text = format!("{error:#}");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
