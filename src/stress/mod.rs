//! Stability: where methods fail, and the search for failures where none should be.
//!
//! A [`Studio`] draws one picture of a scene with several methods and holds the masks against the truth.
//! All the rest makes scenes for it: [`random`] ones; and what is left of a scene that fails when all that
//! does not matter is taken away, by [`minimise`](fn@minimise::minimise).
#![allow(
    missing_docs,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "experiment"
)]

pub mod minimise;
pub mod random;
mod simpler;
mod trial;

pub use trial::{Attempt, Drawn, Studio, Trial};
