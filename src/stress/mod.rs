//! Stability: where methods fail, and the search for failures where none should be.
//!
//! A [`Studio`] draws one picture of a scene with several methods and holds the masks against the truth; a
//! [`Finding`] says whether what came out is a failure, and one that the method declares. All the rest makes
//! scenes for it: [`random`] ones for [`fuzz`](fuzz()).

mod finding;
mod fuzz;
pub mod random;
mod trial;

pub use finding::Finding;
pub use fuzz::{Failure, FuzzPlan, Tally, fuzz};
pub use trial::{Attempt, Drawn, Studio, Trial};
