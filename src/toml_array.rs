//! Arrays of a fixed length in TOML files.

use serde::Deserialize;

/// An array of exactly `N` elements: read as a plain `[T; N]`, a longer one would lose its tail.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(try_from = "Vec<T>", bound = "T: Deserialize<'de>")]
pub struct Exactly<T, const N: usize>(pub [T; N]);

impl<T, const N: usize> TryFrom<Vec<T>> for Exactly<T, N> {
    type Error = String;

    fn try_from(elements: Vec<T>) -> Result<Self, String> {
        <[T; N]>::try_from(elements).map(Self).map_err(|elements| {
            let count = elements.len();
            format!("expected {N} numbers, found {count}")
        })
    }
}
