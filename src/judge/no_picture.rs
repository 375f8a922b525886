//! The one place where whatever goes wrong with a method becomes a reason, and goes no further.

use crate::gpu::Gpu;
use crate::methods::MethodError;
use crate::panics;
use crate::record::in_one_line;
use std::time::Instant;

/// Why there is no picture of a method.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.reason())]
pub enum NoPicture {
    /// The method cannot run on this scene or device, for this reason.
    Unavailable(String),
    /// Something broke: the device was lost or has not enough memory, the method panicked or took too long, or the
    /// scene cannot be traced.
    Failed(String),
}

impl NoPicture {
    /// Why, in words.
    pub fn reason(&self) -> &str {
        match self {
            Self::Unavailable(reason) | Self::Failed(reason) => reason,
        }
    }

    /// The same, and when it happened. What cannot run needs no such place.
    #[must_use]
    pub fn at(self, place: &str) -> Self {
        match self {
            Self::Failed(reason) => Self::Failed(format!("{place}: {reason}")),
            Self::Unavailable(_) => self,
        }
    }
}

impl From<anyhow::Error> for NoPicture {
    fn from(error: anyhow::Error) -> Self {
        if let Some(Self::Unavailable(reason)) = error.downcast_ref() {
            return Self::Unavailable(reason.clone());
        }
        match error.downcast_ref() {
            Some(MethodError::Unavailable(reason)) => Self::Unavailable(reason.clone()),
            _ => Self::Failed(in_one_line(&error)),
        }
    }
}

/// Does `work` for one method on `gpu`. What ends it stays with the method: what the device has against it, a
/// device that is lost or still busy at `deadline`, an error, a panic.
///
/// # Errors
/// The reason.
pub fn contain<T>(
    gpu: &Gpu,
    deadline: Option<Instant>,
    work: impl FnOnce() -> anyhow::Result<T>,
) -> Result<T, NoPicture> {
    let caught = gpu.until(deadline, || panics::catch(|| gpu.attempt(work)));
    let panic = match caught {
        Ok(result) => return Ok(result?),
        Err(panic) => panic,
    };
    // What the device says of the half-made work is nobody else's fault.
    let _ = gpu.attempt(|| Ok::<_, anyhow::Error>(()));
    let place = panic.place.map(|place| format!(" ({place})"));
    let place = place.unwrap_or_default();
    Err(NoPicture::Failed(format!(
        "it panicked: {}{place}",
        panic.text
    )))
}
