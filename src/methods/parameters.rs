//! Method parameters: typed fields, read from a table of a configuration or from a command line.

use super::ShadowMethod;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// A parameter that is unknown, of the wrong type or impossible.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct ParameterError {
    /// What is wrong.
    pub message: String,
    /// Where in the text, in bytes.
    pub span: Option<Range<usize>>,
}

impl From<toml::de::Error> for ParameterError {
    fn from(error: toml::de::Error) -> Self {
        Self {
            message: error.message().to_owned(),
            span: error.span(),
        }
    }
}

/// The parameters of one method: a struct of typed fields with defaults.
pub trait Parameters: Serialize + DeserializeOwned + Default {
    /// Checks values that no type rules out.
    ///
    /// # Errors
    /// What is impossible, naming the parameter.
    fn validate(&self) -> Result<(), String>;

    /// The parameters that are not at their defaults, `name=value` joined by commas.
    fn difference(&self) -> String {
        let as_map = |parameters: &Self| match serde_json::to_value(parameters) {
            Ok(serde_json::Value::Object(map)) => map,
            _ => unreachable!("parameters are a struct of plain values"),
        };
        let defaults = as_map(&Self::default());
        as_map(self)
            .into_iter()
            .filter(|(name, value)| defaults.get(name) != Some(value))
            .map(|(name, value)| match value {
                serde_json::Value::String(text) => format!("{name}={text}"),
                value => format!("{name}={value}"),
            })
            .collect::<Vec<_>>()
            .join(",")
    }
}

/// Reads a method from its table of parameters.
pub(super) fn configure<M>(
    table: Spanned<DeValue<'_>>,
) -> Result<Box<dyn ShadowMethod>, ParameterError>
where
    M: Parameters + ShadowMethod + 'static,
{
    let span = table.span();
    let method = M::deserialize(ValueDeserializer::from(table))?;
    match method.validate() {
        Ok(()) => Ok(Box::new(method)),
        Err(message) => Err(ParameterError {
            message,
            span: Some(span),
        }),
    }
}

/// Reads `ID[,key=value...]`, the form of command lines. Values are TOML; what is no TOML value
/// is taken as a string.
///
/// # Errors
/// A message for people that names the nearest known id or parameter.
pub fn parse_method(text: &str) -> Result<Box<dyn ShadowMethod>, ParameterError> {
    let (id, rest) = text.split_once(',').unwrap_or((text, ""));
    let plain = |message| ParameterError {
        message,
        span: None,
    };
    let registration = super::find(id).ok_or_else(|| plain(unknown_method(id)))?;
    let mut document = String::new();
    for pair in rest.split(',').filter(|pair| !pair.is_empty()) {
        let (key, value) = pair
            .split_once('=')
            .ok_or_else(|| plain(format!("`{pair}` in `{text}` is not of the form key=value")))?;
        match ValueDeserializer::parse(value) {
            Ok(_) => document.push_str(&format!("{key} = {value}\n")),
            Err(_) => document.push_str(&format!("{key} = {value:?}\n")),
        }
    }
    let table = DeTable::parse(&document).map_err(ParameterError::from)?;
    let value = Spanned::new(table.span(), DeValue::Table(table.into_inner()));
    (registration.configure)(value).map_err(|error| {
        let message = crate::toml_error::with_suggestion(&error.message);
        plain(format!("method `{id}`: {message}"))
    })
}

/// The message for an id that is no method.
pub fn unknown_method(id: &str) -> String {
    let ids = || {
        super::REGISTRY
            .iter()
            .map(|registration| registration.info.id)
    };
    let hint = crate::toml_error::nearest(id, ids())
        .map(|nearest| format!("; did you mean `{nearest}`?"))
        .unwrap_or_default();
    format!(
        "unknown method `{id}`{hint} (known: {})",
        ids().collect::<Vec<_>>().join(", ")
    )
}

/// Checks that a parameter lies in its range.
pub(super) fn in_range<T: Copy + PartialOrd + std::fmt::Display>(
    name: &str,
    value: T,
    range: std::ops::RangeInclusive<T>,
) -> Result<(), String> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(format!(
        "`{name}` is {value}; it must be from {} to {}",
        range.start(),
        range.end()
    ))
}
