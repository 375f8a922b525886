//! What a parameter can be set to.

use serde::de::value::Error;
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};
use serde::{Serialize, forward_to_deserialize_any};
use serde_json::Value;
use std::fmt;
use std::ops::RangeInclusive;

/// The values that a parameter can have.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "snake_case")]
pub enum Domain {
    /// A whole number.
    Integer {
        /// The smallest.
        min: i64,
        /// The largest.
        max: i64,
        /// Whether it must be odd.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        odd: bool,
    },
    /// A number.
    Number {
        /// The smallest.
        min: f64,
        /// The largest.
        max: f64,
        /// A word that may stand in its place.
        #[serde(skip_serializing_if = "Option::is_none")]
        or: Option<&'static str>,
    },
    /// One of a few words.
    Choice {
        /// The words.
        choices: &'static [&'static str],
    },
    /// True or false.
    Boolean,
}

impl Domain {
    /// Odd numbers.
    pub fn odd(range: RangeInclusive<u32>) -> Self {
        Self::Integer {
            min: (*range.start()).into(),
            max: (*range.end()).into(),
            odd: true,
        }
    }

    /// Numbers of a range, or a word.
    pub fn or_word(range: RangeInclusive<f64>, word: &'static str) -> Self {
        Self::Number {
            min: *range.start(),
            max: *range.end(),
            or: Some(word),
        }
    }

    /// What a type by itself can be: the words of an enum, true or false.
    ///
    /// # Panics
    /// For other types, which need a range.
    pub fn of<T: DeserializeOwned>() -> Self {
        let mut found = None;
        // Always an error: the question is what the type asks for.
        let _ = T::deserialize(Probe(&mut found));
        match found {
            Some(domain) => domain,
            None => panic!(
                "a parameter of type {} needs a range: `in 1..=8`",
                std::any::type_name::<T>()
            ),
        }
    }

    /// Whether `value` is one of them.
    pub(super) fn contains(&self, value: &Value) -> bool {
        match self {
            Self::Integer { min, max, odd } => value
                .as_i64()
                .is_some_and(|n| (*min..=*max).contains(&n) && (!odd || n % 2 != 0)),
            Self::Number { min, max, or } => match value.as_str() {
                Some(word) => *or == Some(word),
                None => value.as_f64().is_some_and(|x| (*min..=*max).contains(&x)),
            },
            Self::Choice { choices } => value.as_str().is_some_and(|word| choices.contains(&word)),
            Self::Boolean => value.is_boolean(),
        }
    }
}

impl From<RangeInclusive<u32>> for Domain {
    fn from(range: RangeInclusive<u32>) -> Self {
        Self::Integer {
            min: (*range.start()).into(),
            max: (*range.end()).into(),
            odd: false,
        }
    }
}

impl From<RangeInclusive<i32>> for Domain {
    fn from(range: RangeInclusive<i32>) -> Self {
        Self::Integer {
            min: (*range.start()).into(),
            max: (*range.end()).into(),
            odd: false,
        }
    }
}

impl From<RangeInclusive<f64>> for Domain {
    fn from(range: RangeInclusive<f64>) -> Self {
        Self::Number {
            min: *range.start(),
            max: *range.end(),
            or: None,
        }
    }
}

/// As in "it must be ...".
impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer { min, max, odd } => {
                let odd = if *odd { "odd, " } else { "" };
                write!(f, "{odd}from {min} to {max}")
            }
            Self::Number { min, max, or } => {
                write!(f, "from {} to {}", short(*min), short(*max))?;
                or.map_or(Ok(()), |word| write!(f, ", or {word}"))
            }
            Self::Choice { choices } => match choices {
                [others @ .., last] if !others.is_empty() => {
                    write!(f, "{} or {last}", others.join(", "))
                }
                _ => write!(f, "{}", choices.concat()),
            },
            Self::Boolean => write!(f, "true or false"),
        }
    }
}

/// A number as people write it: `1e-9` rather than all its zeros.
fn short(x: f64) -> String {
    match x.abs() {
        0.0 | 1e-4..1e7 => x.to_string(),
        _ => format!("{x:e}"),
    }
}

/// Hears what a type asks a deserializer for.
struct Probe<'a>(&'a mut Option<Domain>);

impl Probe<'_> {
    fn heard<T>(self, domain: Option<Domain>) -> Result<T, Error> {
        *self.0 = domain;
        Err(Error::custom("there is no value"))
    }
}

impl<'de> Deserializer<'de> for Probe<'_> {
    type Error = Error;

    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        self.heard(None)
    }

    fn deserialize_bool<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Error> {
        self.heard(Some(Domain::Boolean))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        choices: &'static [&'static str],
        _: V,
    ) -> Result<V::Value, Error> {
        self.heard(Some(Domain::Choice { choices }))
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit
        unit_struct newtype_struct seq tuple tuple_struct map struct identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;
    use serde_json::json;

    #[derive(Deserialize)]
    #[serde(rename_all = "snake_case")]
    #[allow(dead_code, reason = "only its words are read")]
    enum Size {
        Small,
        VeryLarge,
    }

    #[test]
    fn enums_say_their_words() {
        let size = Domain::of::<Size>();
        assert_eq!(size.to_string(), "small or very_large");
        assert!(size.contains(&json!("very_large")) && !size.contains(&json!("VeryLarge")));
        assert_eq!(Domain::of::<bool>(), Domain::Boolean);
    }

    #[test]
    fn numbers_have_ranges() {
        let odd = Domain::odd(1..=15);
        let is_in = |values: &[i64]| values.iter().all(|n| odd.contains(&json!(n)));
        assert!(is_in(&[1, 3, 15]));
        assert!([0, 4, 16, 17].iter().all(|n| !odd.contains(&json!(n))));
        assert_eq!(odd.to_string(), "odd, from 1 to 15");
        let or_word = Domain::or_word(0.0..=1.5, "search");
        assert!(or_word.contains(&json!(1.5)) && or_word.contains(&json!("search")));
        assert!(!or_word.contains(&json!(1.6)) && !or_word.contains(&json!("find")));
        assert!(!or_word.contains(&json!(f64::NAN)));
        assert_eq!(or_word.to_string(), "from 0 to 1.5, or search");
        assert_eq!(Domain::from(1e-9..=1e9).to_string(), "from 1e-9 to 1e9");
    }
}
