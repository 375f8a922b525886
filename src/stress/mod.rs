//! Stability: where methods fail, and the search for failures where none should be.
//!
//! A [`Studio`] draws one picture of a scene with several methods and holds the masks against the truth.
//! All the rest makes scenes for it: [`random`] ones.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "experiment"
)]

mod change;
mod damage;
#[cfg(test)]
mod fixtures;
pub mod metamorphic;
pub mod random;
mod retold;
mod trial;

pub use change::{Change, Changed, Keeps};
pub use damage::damage;
pub use trial::{Attempt, Drawn, Studio, Trial};
