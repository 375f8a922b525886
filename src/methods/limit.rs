//! What a method cannot do: in words for people, and in causes of the stress corpus for machines.

use super::MethodInfo;
use crate::metrics::Label;
use crate::variant::Variant;
use serde::Serialize;
use std::fmt;

/// Something that a method cannot do or gets wrong, by design.
#[derive(Debug, Clone, Serialize)]
pub struct Limit {
    /// In words.
    pub text: &'static str,
    /// The parameters, name and value, with any of which it holds; with none, it always holds.
    pub with: &'static [(&'static str, &'static str)],
    /// Those with any of which it does not hold.
    pub unless: &'static [(&'static str, &'static str)],
    /// The causes of the stress corpus that fail by it, each with the value from which on they do.
    pub fails: &'static [(&'static str, f64)],
    /// Kinds of error that it leaves in any scene.
    pub kinds: &'static [Label],
    /// How much of a picture it accounts for.
    pub at_most: Bound,
}

/// How many artifact pixels of a picture a limit accounts for: what is more must have another reason.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Bound {
    /// So many, whatever the size of the picture: where single pixels are all that the limit is about.
    Px(u64),
    /// This share of the picture's pixels, 0 to 1.
    Share(f64),
    /// Any number: where the whole picture may be wrong by it.
    All,
}

impl Bound {
    /// Whether so many artifact pixels of a picture are within it.
    pub fn holds(self, artifact_px: u64, picture_px: u64) -> bool {
        match self {
            Self::Px(most_px) => artifact_px <= most_px,
            Self::Share(share) => artifact_px as f64 <= share * picture_px as f64,
            Self::All => true,
        }
    }
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Px(1) => write!(f, "1 artifact pixel"),
            Self::Px(most_px) => write!(f, "{most_px} artifact pixels"),
            // Rounded: 100 * 0.07 is 7.000000000000001.
            Self::Share(share) => write!(f, "{} % of the picture", (1e6 * share).round() / 1e4),
            Self::All => write!(f, "the whole picture"),
        }
    }
}

impl Limit {
    /// One that no cause of the stress corpus shows.
    pub const fn in_words(text: &'static str) -> Self {
        Self {
            text,
            with: &[],
            unless: &[],
            fails: &[],
            kinds: &[],
            at_most: Bound::All,
        }
    }

    /// Whether it holds for a variant of its method.
    fn holds(&self, variant: &Variant) -> bool {
        let is_set = |(name, value): &(&str, &str)| variant.get(name) == Some(value);
        let holds = self.with.is_empty() || self.with.iter().any(is_set);
        holds && !self.unless.iter().any(is_set)
    }

    /// Whether it stands for a cause at a value.
    pub fn covers(&self, cause: &str, value: f64) -> bool {
        let is_it = |(name, from): &(&str, f64)| *name == cause && value >= *from;
        self.fails.iter().any(is_it)
    }
}

/// What single precision cannot do, in any method.
pub(super) const PRECISION_LIMIT: Limit = Limit {
    text: "vertices are projected in 32-bit floats: wrong where coordinates are a million times as large as \
           what the picture shows",
    with: &[],
    unless: &[],
    fails: &[("translation", 6.0), ("large_triangles", 6.0)],
    kinds: &[],
    at_most: Bound::Share(0.2),
};

impl MethodInfo {
    /// The limits that hold for a variant of the method.
    pub fn limits_of(&self, variant: &Variant) -> impl Iterator<Item = &'static Limit> {
        let limits = self.limits.iter().copied().flatten();
        limits.filter(move |limit| limit.holds(variant))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_holds_with_some_parameters_and_not_with_others() {
        let limit = Limit {
            unless: &[("counter", "blend16"), ("counter", "blend32")],
            ..Limit::in_words("wraps around")
        };
        let holds = |variant: &str| limit.holds(&variant.parse().unwrap());
        assert!(holds("") && holds("counting=auto"));
        assert!(!holds("counter=blend32,counting=auto"));
        let only_with = Limit {
            with: &[("counting", "auto")],
            ..limit.clone()
        };
        let holds = |variant: &str| only_with.holds(&variant.parse().unwrap());
        assert!(holds("counting=auto") && !holds("") && !holds("counting=auto,counter=blend16"));
    }

    #[test]
    fn bounds_are_of_pixels_or_of_the_picture() {
        assert!(Bound::Px(16).holds(16, 100) && !Bound::Px(16).holds(17, 1_000_000));
        assert!(Bound::Share(0.07).holds(7, 100) && !Bound::Share(0.07).holds(8, 100));
        assert!(Bound::All.holds(100, 100));
        let words =
            [Bound::Px(1), Bound::Px(16), Bound::Share(0.07), Bound::All].map(|b| b.to_string());
        let expected = [
            "1 artifact pixel",
            "16 artifact pixels",
            "7 % of the picture",
            "the whole picture",
        ];
        assert_eq!(words, expected);
        let json = |bound: Bound| serde_json::to_string(&bound).unwrap();
        assert_eq!(json(Bound::Px(16)), r#"{"px":16}"#);
        assert_eq!(json(Bound::Share(0.25)), r#"{"share":0.25}"#);
        assert_eq!(json(Bound::All), r#""all""#);
    }
}
