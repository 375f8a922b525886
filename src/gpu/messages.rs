//! Messages of the driver and its validation layers.
//!
//! wgpu hands them to the `log` facade. This logger counts those of the Vulkan validation layers,
//! so that a run or a test can fail on them, and prints warnings and errors to standard error.

use crate::console;
use std::sync::{Mutex, Once, PoisonError};

/// Parts of messages that are the layers' fault and not ours, with the reason.
const NOT_OURS: &[(&str, &str)] = &[(
    "Invalid source language operand: 10",
    "layers of version 1.3.239 (Debian 12) do not know WGSL as the source language of SPIR-V",
)];

struct Messages;

static INSTALL: Once = Once::new();
static COLLECTED: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Installs the logger; later calls do nothing. Another logger that is already installed stays.
pub fn install() {
    INSTALL.call_once(|| {
        if log::set_logger(&Messages).is_ok() {
            log::set_max_level(log::LevelFilter::Warn);
        }
    });
}

/// Takes the validation messages collected so far.
pub fn take_validation_messages() -> Vec<String> {
    std::mem::take(&mut *COLLECTED.lock().unwrap_or_else(PoisonError::into_inner))
}

impl log::Log for Messages {
    fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
        metadata.level() <= log::Level::Warn
    }

    fn log(&self, record: &log::Record<'_>) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let text = record.args().to_string();
        // What follows a message on lines of its own: the objects and labels that it is about.
        let is_detail = text.starts_with('\t');
        if is_detail || NOT_OURS.iter().any(|(part, _reason)| text.contains(part)) {
            return;
        }
        console::say(&format!(
            "{}: {text}",
            record.level().as_str().to_lowercase()
        ));
        // The messenger's record starts with the message type and the id: `VALIDATION [VUID-...`.
        if record.target().contains("vulkan::instance") && text.starts_with("VALIDATION") {
            COLLECTED
                .lock()
                .unwrap_or_else(PoisonError::into_inner)
                .push(text);
        }
    }

    fn flush(&self) {}
}
