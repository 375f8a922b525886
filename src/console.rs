//! Standard output and standard error: the only place that writes to them.
//!
//! Printing never panics and never ends anything. A reader that goes away (`| head`) has read what it wanted. Where
//! what is printed is all that a command has to show, it asks [`check_printed`] in the end.

use anyhow::Context;
use std::io::{self, Write};
use std::sync::{Mutex, PoisonError};

/// Why something that was to be printed is lost.
static LOST: Mutex<Option<io::Error>> = Mutex::new(None);

/// Prints to standard output.
pub fn print(text: &str) {
    let mut out = io::stdout().lock();
    let printed = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    note(printed);
}

/// Prints a line to standard error; if that is lost, so be it.
pub fn say(line: &str) {
    // In one piece, so that lines of several threads stay whole.
    let _ = io::stderr().write_all(format!("{line}\n").as_bytes());
}

/// Remembers that something could not be printed to standard output; a reader that went away is no loss.
pub fn note(printed: io::Result<()>) {
    match printed {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            let mut lost = LOST.lock().unwrap_or_else(PoisonError::into_inner);
            lost.get_or_insert(error);
        }
        _ => {}
    }
}

/// Fails if something that was printed is lost.
///
/// # Errors
/// When standard output could not take it, as on a full disk.
pub fn check_printed() -> anyhow::Result<()> {
    let lost = LOST.lock().unwrap_or_else(PoisonError::into_inner).take();
    lost.map_or(Ok(()), Err)
        .context("cannot write to standard output")
}
