//! Outputs that would destroy what the command reads, or each other.

use crate::config::ConfigError;
use crate::output::is_same_file;
use std::path::{Path, PathBuf};

/// Refuses outputs, each with its option, that are one of the inputs or the same as another.
///
/// # Errors
/// When one is; the message names it.
pub(super) fn check(inputs: &[PathBuf], outputs: &[(&str, &Path)]) -> Result<(), ConfigError> {
    for (i, (option, path)) in outputs.iter().enumerate() {
        let refuse = |what: String| {
            let path = path.display();
            Err(ConfigError(format!(
                "{option}: {path} {what}; name another file"
            )))
        };
        if inputs.iter().any(|input| is_same_file(input, path)) {
            return refuse("is read by this command".to_owned());
        }
        let earlier = &outputs[..i];
        if let Some((other, _)) = earlier.iter().find(|(_, other)| is_same_file(other, path)) {
            return refuse(format!("is also what {other} writes"));
        }
    }
    Ok(())
}
