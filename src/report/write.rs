//! Files that are either whole or not there.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result};

/// Writes `text` to `path`, whole or not at all.
pub(super) fn text(path: &Path, text: &str) -> Result<()> {
    replace(path, |partial| Ok(fs::write(partial, text)?))
}

/// Lets `write` make a file under a passing name in the same folder, then renames it to `path`.
///
/// The passing name keeps the extension, by which image encoders choose their format.
pub(super) fn replace(path: &Path, write: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let partial = path.with_file_name(format!(".partial-{name}"));
    let written = write(&partial)
        .and_then(|()| Ok(fs::rename(&partial, path)?))
        .with_context(|| {
            format!(
                "cannot write {}; is the folder writable and the disk not full?",
                path.display()
            )
        });
    if written.is_err() {
        // Nothing better can be done with an error here, and the first one is the one to report.
        let _ = fs::remove_file(&partial);
    }
    written
}

/// Removes a file that an earlier report may have left.
pub(super) fn remove(path: &Path) -> Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(error).with_context(|| format!("cannot remove {}", path.display()))
        }
        _ => Ok(()),
    }
}
