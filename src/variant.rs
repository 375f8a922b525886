//! The parameters that tell a variant of a method from its defaults, as results and command lines write them.

use serde::{Deserialize, Serialize};
use std::fmt::{self, Display};
use std::str::FromStr;

/// The parameters of a method that are not at their defaults: `resolution=8192,pcf=3`; empty for the default variant.
///
/// In tables, JSON and on command lines it is this text. It is parsed here and nowhere else.
///
/// ```
/// use svbench::variant::Variant;
/// let variant: Variant = "resolution=8192,pcf=3".parse().unwrap();
/// assert_eq!(variant.get("pcf"), Some("3"));
/// assert_eq!(variant.without("pcf").to_string(), "resolution=8192");
/// assert_eq!(variant.full_name("shadow_map"), "shadow_map,resolution=8192,pcf=3");
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct Variant(String);

/// Text that is no list of parameters.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{part}` in `{text}` is not of the form name=value")]
pub struct VariantError {
    part: String,
    text: String,
}

impl Variant {
    /// The variant with these parameters.
    pub fn of<N: Display, V: Display>(parameters: impl IntoIterator<Item = (N, V)>) -> Self {
        let parts = parameters.into_iter();
        let parts: Vec<String> = parts.map(|(n, v)| format!("{n}={v}")).collect();
        Self(parts.join(","))
    }

    /// Its text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether all parameters are at their defaults.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Names and values.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.split(',').filter_map(|part| part.split_once('='))
    }

    /// The value of a parameter, unless it is at its default.
    pub fn get(&self, name: &str) -> Option<&str> {
        self.parameters()
            .find_map(|(known, value)| (known == name).then_some(value))
    }

    /// All parameters but one.
    pub fn without(&self, name: &str) -> Self {
        Self::of(self.parameters().filter(|(known, _)| *known != name))
    }

    /// The method `id` in this variant, as command lines name it: `id,name=value`.
    pub fn full_name(&self, id: &str) -> String {
        let comma = if self.is_empty() { "" } else { "," };
        format!("{id}{comma}{self}")
    }
}

impl FromStr for Variant {
    type Err = VariantError;

    fn from_str(text: &str) -> Result<Self, VariantError> {
        let parts: Vec<&str> = text.split(',').filter(|part| !part.is_empty()).collect();
        let is_parameter = |part: &&str| part.find('=').is_some_and(|at| at > 0);
        match parts.iter().find(|part| !is_parameter(part)) {
            Some(part) => Err(VariantError {
                part: (*part).to_owned(),
                text: text.to_owned(),
            }),
            None => Ok(Self(parts.join(","))),
        }
    }
}

impl TryFrom<String> for Variant {
    type Error = VariantError;

    fn try_from(text: String) -> Result<Self, VariantError> {
        text.parse()
    }
}

impl From<Variant> for String {
    fn from(variant: Variant) -> Self {
        variant.0
    }
}

impl Display for Variant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_parameters_are_one() {
        for text in ["", "pcf=3", "resolution=8192,slope_bias=-0.5", "a=b=c,d="] {
            let variant: Variant = text.parse().unwrap();
            assert_eq!(variant.as_str(), text);
            assert_eq!(Variant::of(variant.parameters()), variant);
        }
        let variant: Variant = "resolution=8192,slope_bias=-0.5".parse().unwrap();
        let parameters: Vec<_> = variant.parameters().collect();
        assert_eq!(parameters, [("resolution", "8192"), ("slope_bias", "-0.5")]);
        assert_eq!(variant.get("slope_bias"), Some("-0.5"));
        assert_eq!(variant.get("bias"), None);
        assert_eq!(variant.without("resolution").as_str(), "slope_bias=-0.5");
        assert_eq!(Variant::default().full_name("shadow_map"), "shadow_map");
    }

    #[test]
    fn what_is_no_parameter_is_named() {
        for text in ["pcf", "a=1,pcf", "=3", "a=1, ,pcf=3"] {
            let error = text.parse::<Variant>().unwrap_err().to_string();
            assert!(error.contains(&format!("in `{text}`")), "{error}");
        }
    }
}
