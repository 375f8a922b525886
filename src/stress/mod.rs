//! Stability: where methods fail, and the search for failures where none should be.
//!
//! A [`Judge`](crate::judge::Judge) draws one picture of a scene with several methods and holds the masks against the truth; a
//! [`Finding`] says whether what came out is a failure, and one that the method declares. All the rest makes
//! scenes for it: the [`corpus`] of causes for [`sweep`](sweep()), [`random`] ones for [`fuzz`](fuzz()),
//! rewritten scenes for [`metamorphic`], and ever smaller ones, until only what fails is left, for
//! [`minimise`](fn@minimise::minimise).

mod cause;
mod change;
mod damage;
mod families;
mod finding;
#[cfg(test)]
mod fixtures;
mod fuzz;
pub mod metamorphic;
pub mod minimise;
mod plan;
pub mod random;
mod rewrite;
mod simpler;
mod sweep;

pub use cause::{Cause, CauseError, corpus, find_cause};
pub use change::{Change, Keeps};
pub use damage::damage;
pub use finding::Finding;
pub use fuzz::{Failure, FuzzPlan, Tally, fuzz};
pub use plan::{StressPlan, cause_called};
pub use rewrite::Changed;
pub use sweep::{StressRequest, sweep};
