//! What goes wrong with a run directory, and errors as they stand in tables.

/// The run directory cannot be written: the one error that ends a run.
///
/// It is made by the run directory alone, and no other error becomes one by itself.
#[derive(Debug, thiserror::Error)]
#[error("{0:#}")]
pub(crate) struct RunDirError(anyhow::Error);

impl RunDirError {
    pub(crate) fn of<T>(result: anyhow::Result<T>) -> Result<T, Self> {
        result.map_err(Self)
    }

    pub(crate) fn into_inner(self) -> anyhow::Error {
        self.0
    }
}

/// An error and its causes, for a table.
pub(crate) fn in_one_line(error: &anyhow::Error) -> String {
    let text = format!("{error:#}");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
