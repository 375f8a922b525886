//! What a method cannot do: in words for people, and in causes of the stress corpus for machines.

use super::MethodInfo;
use crate::metrics::Label;
use serde::Serialize;

/// Something that a method cannot do or gets wrong, by design.
#[derive(Debug, Clone, Serialize)]
pub struct Limit {
    /// In words.
    pub text: &'static str,
    /// The parameters, name and value, with any of which it holds; with none, it always holds.
    pub with: &'static [(&'static str, &'static str)],
    /// The causes of the stress corpus that fail by it, each with the value from which on they do.
    pub fails: &'static [(&'static str, f64)],
    /// Kinds of error that it leaves in any scene.
    pub kinds: &'static [Label],
    /// Most artifact pixels of a picture that it accounts for: few where single pixels are all it is about.
    pub most_px: u64,
}

impl Limit {
    /// One that no cause of the stress corpus shows.
    pub(super) const fn in_words(text: &'static str) -> Self {
        Self {
            text,
            with: &[],
            fails: &[],
            kinds: &[],
            most_px: u64::MAX,
        }
    }

    /// Whether it holds for a variant, see [`super::ShadowMethod::variant`].
    fn holds(&self, variant: &str) -> bool {
        let is_set = |(name, value): &(&str, &str)| {
            let parameters = variant.split(',').filter_map(|pair| pair.split_once('='));
            parameters.into_iter().any(|pair| pair == (*name, *value))
        };
        self.with.is_empty() || self.with.iter().any(is_set)
    }

    /// Whether it stands for a cause at a value.
    pub fn covers(&self, cause: &str, value: f64) -> bool {
        let is_it = |(name, from): &(&str, f64)| *name == cause && value >= *from;
        self.fails.iter().any(is_it)
    }
}

/// What single precision cannot do, in any method.
pub(super) const PRECISION_LIMIT: Limit = Limit {
    text: "vertices become places on the screen in 32 bits: wrong where coordinates are 100,000 times what the \
           picture shows",
    with: &[],
    fails: &[("translation", 5.0), ("large_triangles", 5.0)],
    kinds: &[],
    most_px: u64::MAX,
};

impl MethodInfo {
    /// The limits that hold for a variant of the method, see [`super::ShadowMethod::variant`].
    pub fn limits_of(&self, variant: &str) -> impl Iterator<Item = &'static Limit> {
        let limits = self.limits.iter().copied().flatten();
        limits.filter(move |limit| limit.holds(variant))
    }
}
