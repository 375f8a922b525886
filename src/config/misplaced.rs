//! Complaints about a configuration's text.

use crate::toml_error;
use std::ops::Range;

/// A complaint about a part of the text.
pub(crate) struct Misplaced {
    pub(crate) span: Option<Range<usize>>,
    pub(crate) message: String,
}

impl Misplaced {
    pub(crate) fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            span: Some(span),
            message: message.into(),
        }
    }
}

impl From<toml::de::Error> for Misplaced {
    fn from(error: toml::de::Error) -> Self {
        Self {
            span: error.span(),
            message: toml_error::with_suggestion(error.message()),
        }
    }
}

/// A list of tables that must not be empty.
pub(crate) fn missing(key: &str, example: &str) -> Misplaced {
    let message = format!("no `[[{key}]]`: name at least one, for example `{example}`");
    Misplaced {
        span: None,
        message,
    }
}

/// Results tell cells apart by scene, method and variant.
pub(crate) fn twice(span: Range<usize>, what: &str, name: &str) -> Misplaced {
    let message = format!("the {what} `{name}` is there already; remove one of the two");
    Misplaced::new(span, message)
}
