//! Method parameters: each declared once, with its type, default, range and meaning, by
//! [`parameters!`](crate::parameters!).

use super::domain::Domain;
use crate::variant::Variant;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// A value of a configuration, with its place.
pub type ParameterValue<'a> = Spanned<DeValue<'a>>;

/// A parameter that is unknown, of the wrong type or impossible.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct ParameterError {
    /// What is wrong.
    pub message: String,
    /// Where in the text, in bytes.
    pub span: Option<Range<usize>>,
}

impl ParameterError {
    /// One that says where it is by itself.
    pub(super) fn plain(message: String) -> Self {
        Self {
            message,
            span: None,
        }
    }
}

impl From<toml::de::Error> for ParameterError {
    fn from(error: toml::de::Error) -> Self {
        Self {
            message: error.message().to_owned(),
            span: error.span(),
        }
    }
}

/// A parameter of a method, as declared and as set.
#[derive(Debug, Clone, Serialize)]
pub struct Parameter {
    /// Its name in configurations.
    pub name: &'static str,
    /// What it is unless set; null for what then depends on something else.
    pub default: Value,
    /// What it can be set to.
    #[serde(flatten)]
    pub domain: Domain,
    /// What it means.
    pub words: String,
    /// What it is set to.
    #[serde(skip)]
    pub value: Value,
}

impl Parameter {
    /// A parameter of a type that reads and writes plain values.
    pub fn new<T: Serialize>(
        name: &'static str,
        (value, default): (&T, &T),
        domain: Domain,
        words: impl Into<String>,
    ) -> Self {
        let json = |value| match serde_json::to_value(value) {
            Ok(value) => value,
            Err(error) => panic!("the parameter `{name}` is no plain value: {error}"),
        };
        Self {
            name,
            default: json(default),
            domain,
            words: words.into(),
            value: json(value),
        }
    }

    /// Its default, as in configurations, without quotes.
    pub fn default_text(&self) -> String {
        text(&self.default)
    }

    /// Whether it is set to what it can be, and variants can be told apart by it.
    fn check(&self) -> Result<(), String> {
        if text(&self.value).contains(',') {
            let Self { name, value, .. } = self;
            return Err(format!(
                "`{name}` is {value}; a value must not have a comma"
            ));
        }
        if self.domain.contains(&self.value) {
            return Ok(());
        }
        let value = match &self.value {
            // What JSON has no number for.
            Value::Null => "not finite".to_owned(),
            value => text(value),
        };
        let Self { name, domain, .. } = self;
        Err(format!("`{name}` is {value}; it must be {domain}"))
    }
}

fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null => "none".to_owned(),
        value => value.to_string(),
    }
}

/// What has parameters. Implemented by [`parameters!`](crate::parameters!).
pub trait Parameters {
    /// All of them.
    fn parameters(&self) -> Vec<Parameter>;

    /// Sets one; false if none has that name.
    ///
    /// # Errors
    /// When the value is of another type.
    fn set(&mut self, name: &str, value: &ParameterValue<'_>) -> Result<bool, ParameterError>;
}

/// A value of a configuration as a type of this program.
///
/// # Errors
/// When it is of another type.
pub fn read<T: DeserializeOwned>(value: &ParameterValue<'_>) -> Result<T, ParameterError> {
    let span = value.span();
    T::deserialize(ValueDeserializer::from(value.clone())).map_err(|error| ParameterError {
        span: Some(span),
        ..error.into()
    })
}

/// The parameters that are not at their defaults, in the order of their names.
pub(super) fn difference(mut parameters: Vec<Parameter>) -> Variant {
    parameters.sort_by_key(|parameter| parameter.name);
    let changed = parameters.iter().filter(|p| p.value != p.default);
    Variant::of(changed.map(|p| (p.name, text(&p.value))))
}

/// Sets what a table names, and checks it.
pub(super) fn configure(
    target: &mut (impl Parameters + ?Sized),
    table: &DeTable<'_>,
) -> Result<(), ParameterError> {
    for (key, value) in table {
        if !target.set(key.get_ref(), value)? {
            let known = target.parameters();
            let names: Vec<_> = known.iter().map(|p| format!("`{}`", p.name)).collect();
            let (unknown, names) = (key.get_ref(), names.join(", "));
            return Err(ParameterError {
                message: format!("unknown field `{unknown}`, expected one of {names}"),
                span: Some(key.span()),
            });
        }
    }
    for parameter in target.parameters() {
        if let Some(value) = table.get(parameter.name) {
            parameter.check().map_err(|message| ParameterError {
                message,
                span: Some(value.span()),
            })?;
        }
    }
    Ok(())
}
