//! A mask drawn and held against the ray-traced truth: for runs, for stability, and for single pictures alike.

mod observer;
mod trial;
mod verifier;

pub use observer::Observer;
pub use trial::{Attempt, Drawn, Judge, NoPicture, Trial};
pub(crate) use verifier::flicker;
pub use verifier::{Judgement, PixelTruth, Truth, Verifier};
