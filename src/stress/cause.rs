//! Causes of failure: families of scenes, each with one number that turns the cause up.
//!
//! A cause is a TOML file that names a family of scenes, says what its number is and why it hurts, and
//! lists the values to try. Those in `scenes/stress` come with the program: the corpus.

use super::families::Family;
use crate::record::stress::CauseRecord;
use crate::scene::Scene;
use crate::toml_error;
use include_dir::{Dir, include_dir};
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

static FILES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/scenes/stress");

/// A cause of failure: a family of scenes and the number that turns the cause up.
#[derive(Clone, Debug, PartialEq)]
pub struct Cause {
    /// Stem of its file.
    pub id: String,
    /// What people call it.
    pub title: String,
    /// What the number is.
    pub number: String,
    /// Which methods fail in theory, and where.
    pub why: String,
    /// The values to try, ascending; the first is harmless where there is a harmless one.
    pub values: Vec<f64>,
    family: Family,
}

/// Why a file describes no cause; the text names the place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct CauseError(String);

/// A cause as its file says it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CauseWire {
    title: String,
    family: Family,
    number: String,
    why: String,
    values: Spanned<Vec<Spanned<f64>>>,
}

impl Cause {
    /// Checks the text of a file. Errors name the file so; the cause has its stem as id.
    ///
    /// # Errors
    /// When it is no such TOML, when the values do not ascend, or when the family cannot take one of them.
    pub fn parse(text: &str, name_for_errors: &str) -> Result<Self, CauseError> {
        let wire: CauseWire = toml::from_str(text)
            .map_err(|error| CauseError(toml_error::describe(&error, text, name_for_errors)))?;
        let wrong =
            |span, message: &str| CauseError(toml_error::at(&span, message, text, name_for_errors));
        let mut values: Vec<f64> = Vec::new();
        for value in wire.values.get_ref() {
            let (span, value) = (value.span(), *value.get_ref());
            let refused = wire.family.refusal(value);
            if let Some(message) = refused {
                return Err(wrong(span, &message));
            }
            if values.last().is_some_and(|last| *last >= value) {
                return Err(wrong(span, "the values must ascend"));
            }
            values.push(value);
        }
        if values.is_empty() {
            let message = "a cause needs at least one value";
            return Err(wrong(wire.values.span(), message));
        }
        let stem = Path::new(name_for_errors).file_stem().unwrap_or_default();
        Ok(Self {
            id: stem.to_string_lossy().into_owned(),
            title: wire.title,
            number: wire.number,
            why: wire.why,
            values,
            family: wire.family,
        })
    }

    /// Says why there is no scene for a value, if there is none.
    pub fn refusal(&self, value: f64) -> Option<String> {
        self.family.refusal(value)
    }

    /// The scene of one value, with one view. The same family, value and seed always make the same scene;
    /// the seed matters where something in it is random.
    ///
    /// # Panics
    /// When the family cannot take the value, see [`Self::refusal`]; those in [`Self::values`] it can.
    pub fn scene(&self, value: f64, seed: u64) -> Scene {
        if let Some(message) = self.refusal(value) {
            panic!("{}: {message}", self.id);
        }
        let title = format!("{}: {value}", self.title);
        let name = format!("{}_{value}", self.id);
        self.family.scene(value, seed, name, title)
    }
}

/// All causes that come with the program, in alphabetical order.
pub fn corpus() -> Vec<Cause> {
    let mut causes: Vec<Cause> = FILES
        .files()
        .map(|file| {
            let text = file.contents_utf8().unwrap_or_default();
            // A test reads them all.
            Cause::parse(text, &file.path().to_string_lossy())
                .unwrap_or_else(|error| unreachable!("a file of the program is wrong: {error}"))
        })
        .collect();
    causes.sort_unstable_by(|one, other| one.id.cmp(&other.id));
    causes
}

/// The cause of this id that comes with the program.
pub fn find_cause(id: &str) -> Option<Cause> {
    corpus().into_iter().find(|cause| cause.id == id)
}

#[cfg(test)]
#[path = "cause_tests.rs"]
mod tests;

impl Cause {
    /// What results say of it.
    pub fn record(&self) -> CauseRecord {
        CauseRecord {
            id: self.id.clone(),
            title: self.title.clone(),
            number: self.number.clone(),
            why: self.why.split_whitespace().collect::<Vec<_>>().join(" "),
            values: self.values.clone(),
        }
    }
}
