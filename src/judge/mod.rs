//! A mask drawn and held against the ray-traced truth: for runs, for stability, and for single pictures alike.
//!
//! - [`DeviceScene`] makes methods ready on a device: the one place that chooses frame resources, checks what the
//!   device can do, and prepares.
//! - [`Verifier`] knows what is true of a scene, and compares masks with it.
//! - [`Judge`] tries methods on whole scenes, on a device that may be lost meanwhile.
//! - [`contain`] keeps what goes wrong with a method from everything else.

mod comparison;
mod device_scene;
mod no_picture;
mod observer;
mod questions;
mod trial;
mod verifier;

pub use comparison::Judgement;
pub(crate) use comparison::flicker;
pub use device_scene::{DeviceScene, ReadyMethod};
pub use no_picture::{NoPicture, contain};
pub use observer::Observer;
pub use questions::PixelTruth;
pub use trial::{Attempt, Drawn, Judge, Trial};
pub use verifier::{Truth, Verifier};
