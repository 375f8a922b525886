//! Method parameters: typed fields, read from a table of a configuration or from a command line.

use super::ShadowMethod;
use crate::variant::{Variant, VariantError};
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

    /// The parameters that are not at their defaults.
    fn difference(&self) -> Variant {
        let defaults = fields(&Self::default());
        let changed = fields(self).into_iter();
        let changed = changed.filter(|(name, value)| defaults.get(name) != Some(value));
        Variant::of(changed.map(|(name, value)| (name, text(&value))))
    }
}

/// A value as variants write it.
fn text(value: &serde_json::Value) -> String {
    match value {
        serde_json::Value::String(text) => text.clone(),
        value => value.to_string(),
    }
}

/// Reads a method from its table of parameters.
pub(super) fn configure<M>(
    table: &Spanned<DeTable<'_>>,
) -> Result<Box<dyn ShadowMethod>, ParameterError>
where
    M: Parameters + ShadowMethod + 'static,
{
    let span = table.span();
    check_known::<M>(table.get_ref())?;
    let method = read::<M>(table.get_ref().clone())
        .map_err(|error| blame::<M>(table.get_ref()).unwrap_or(error))?;
    match method.validate().and_then(|()| check_text(&method)) {
        Ok(()) => Ok(Box::new(method)),
        Err(message) => Err(ParameterError {
            message,
            span: Some(span),
        }),
    }
}

fn read<M: Parameters>(table: DeTable<'_>) -> Result<M, ParameterError> {
    let value = DeValue::Table(table);
    Ok(M::deserialize(ValueDeserializer::from(Spanned::new(
        0..0,
        value,
    )))?)
}

/// Variants could not be told apart if a value had a comma.
fn check_text<M: Parameters>(method: &M) -> Result<(), String> {
    let fields = fields(method);
    let mut fields = fields.iter().map(|(name, value)| (name, text(value)));
    match fields.find(|(_, value)| value.contains(',')) {
        Some((name, value)) => Err(format!(
            "`{name}` is {value}; a value must not have a comma"
        )),
        None => Ok(()),
    }
}

/// Serde cannot refuse unknown fields where a struct takes up another's.
fn check_known<M: Parameters>(table: &DeTable<'_>) -> Result<(), ParameterError> {
    let known = fields(&M::default());
    let unknown = table
        .keys()
        .find(|key| !known.contains_key(key.get_ref().as_ref()));
    let Some(unknown) = unknown else {
        return Ok(());
    };
    let names: Vec<_> = known.keys().map(|name| format!("`{name}`")).collect();
    Err(ParameterError {
        message: format!(
            "unknown field `{}`, expected one of {}",
            unknown.get_ref(),
            names.join(", ")
        ),
        span: Some(unknown.span()),
    })
}

/// The parameter that is wrong by itself: serde does not say where, for one that a struct takes up from
/// another.
fn blame<M: Parameters>(table: &DeTable<'_>) -> Option<ParameterError> {
    table.iter().find_map(|(key, value)| {
        let alone = DeTable::from_iter([(key.clone(), value.clone())]);
        let error = read::<M>(alone).err()?;
        let span = Some(value.span());
        Some(ParameterError { span, ..error })
    })
}

/// The parameters by name.
fn fields<P: Parameters>(parameters: &P) -> serde_json::Map<String, serde_json::Value> {
    match serde_json::to_value(parameters) {
        Ok(serde_json::Value::Object(map)) => map,
        _ => unreachable!("parameters are a struct of plain values"),
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
    let variant: Variant = rest
        .parse()
        .map_err(|error: VariantError| plain(format!("method `{id}`: {error}")))?;
    let mut document = String::new();
    for (key, value) in variant.parameters() {
        match ValueDeserializer::parse(value) {
            Ok(_) => document.push_str(&format!("{key} = {value}\n")),
            Err(_) => document.push_str(&format!("{key} = {value:?}\n")),
        }
    }
    let table = DeTable::parse(&document).map_err(ParameterError::from)?;
    (registration.configure)(&table).map_err(|error| {
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
