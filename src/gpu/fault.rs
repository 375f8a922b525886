//! What a device has against the work that it is given, as errors for whoever gave it.
//!
//! wgpu tells of most errors by a callback whose default is a panic, and of a lost device by another. Both are
//! noted here, and [`super::Gpu::attempt`] hands them to the caller whose work was under way.

use crate::panics;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// Why a device did not do what it was asked to.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DeviceError {
    /// More than it can hold or bind, known before it was asked.
    #[error("{0}")]
    TooLarge(String),
    /// It ran out of memory.
    #[error("the device ran out of memory: {0}")]
    OutOfMemory(String),
    /// It is gone, with all that was made on it.
    #[error("the device was lost: {0}")]
    Lost(String),
    /// It refused something that it should be able to do.
    #[error("the device refused this: {0}")]
    Refused(String),
}

/// What a device told of its own accord.
#[derive(Debug, Default)]
pub(super) struct Faults {
    /// The first error that nobody has taken yet: later ones mostly follow from it.
    first: Mutex<Option<DeviceError>>,
    /// Why the device was lost, once it is.
    lost: Mutex<Option<String>>,
    /// Whether it was given up because it did not come to an end.
    hangs: AtomicBool,
    /// How long it is waited for at most.
    deadline: Mutex<Option<Instant>>,
}

impl Faults {
    /// Listens to `device` from now on.
    pub(super) fn of(device: &wgpu::Device) -> Arc<Self> {
        let faults = Arc::new(Self::default());
        let heard = Arc::clone(&faults);
        device.on_uncaptured_error(Arc::new(move |error| heard.note(error.into())));
        let heard = Arc::clone(&faults);
        device.set_device_lost_callback(move |_, message| heard.lose(&message));
        faults
    }

    fn note(&self, error: DeviceError) {
        let mut first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        first.get_or_insert(error);
    }

    fn lose(&self, message: &str) {
        let reason = match message {
            "" => "nothing more is known",
            text => text,
        };
        let mut lost = self.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.get_or_insert_with(|| reason.to_owned());
    }

    /// Gives the device up: what it was given goes on, and nobody knows for how long.
    pub(super) fn hang(&self) -> DeviceError {
        let text = "it did not finish its work in time";
        self.hangs.store(true, Ordering::Relaxed);
        self.lose(text);
        DeviceError::Lost(text.to_owned())
    }

    /// Whether it was given up by [`Self::hang`].
    pub(super) fn hangs(&self) -> bool {
        self.hangs.load(Ordering::Relaxed)
    }

    /// How long the device is waited for at most.
    pub(super) fn deadline(&self) -> Option<Instant> {
        *self.deadline.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Sets [`Self::deadline`], and gives the one before.
    pub(super) fn replace_deadline(&self, deadline: Option<Instant>) -> Option<Instant> {
        let mut now = self.deadline.lock().unwrap_or_else(PoisonError::into_inner);
        std::mem::replace(&mut *now, deadline)
    }

    /// The device's loss, if it is lost.
    pub(super) fn lost(&self) -> Option<DeviceError> {
        let lost = self.lost.lock().unwrap_or_else(PoisonError::into_inner);
        lost.clone().map(DeviceError::Lost)
    }

    /// What went wrong since the last time; a lost device explains all else.
    pub(super) fn take(&self) -> Option<DeviceError> {
        let mut first = self.first.lock().unwrap_or_else(PoisonError::into_inner);
        let first = first.take();
        self.lost().or(first)
    }
}

impl From<wgpu::Error> for DeviceError {
    fn from(error: wgpu::Error) -> Self {
        match error {
            wgpu::Error::OutOfMemory { source } => Self::OutOfMemory(in_one_line(&chain(&*source))),
            wgpu::Error::Validation { source, .. } | wgpu::Error::Internal { source, .. } => {
                Self::Refused(in_one_line(&chain(&*source)))
            }
        }
    }
}

/// An error and its causes.
fn chain(error: &(dyn std::error::Error + 'static)) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    let texts: Vec<_> = causes.map(ToString::to_string).collect();
    texts.join(": ")
}

fn in_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Waits for work on `device`, as `how` says.
///
/// # Errors
/// When the device is lost, or does not come to its end in time.
pub(super) fn poll(device: &wgpu::Device, how: wgpu::PollType) -> Result<(), PollFault> {
    // Where the wait itself finds the device lost, wgpu has no error for it, and panics.
    match panics::catch(|| device.poll(how)) {
        Ok(Ok(_)) => Ok(()),
        Ok(Err(wgpu::PollError::Timeout)) => Err(PollFault::Late),
        Ok(Err(error)) => Err(PollFault::Lost(error.to_string())),
        Err(panic) => Err(PollFault::Lost(panic.text)),
    }
}

/// Why a wait came to nothing.
pub(super) enum PollFault {
    /// The device went on for longer than it was waited for.
    Late,
    /// The device is lost.
    Lost(String),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_error_is_taken_once_and_a_loss_stays() {
        let faults = Faults::default();
        let refused = |text: &str| DeviceError::Refused(text.to_owned());
        faults.note(refused("first"));
        faults.note(refused("second"));
        assert_eq!(faults.take(), Some(refused("first")));
        assert_eq!(faults.take(), None);
        faults.note(refused("third"));
        faults.lose("gone");
        faults.lose("");
        let lost = Some(DeviceError::Lost("gone".to_owned()));
        assert_eq!(
            [faults.take(), faults.take(), faults.lost()],
            [lost.clone(), lost.clone(), lost]
        );
    }
}
