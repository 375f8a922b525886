//! Draws a mask and compares it with the ray-traced reference: for runs, for stability and for single pictures alike.
//!
//! `bench`, `stress` and `render` ask the same question, so they ask it here: a wrong pixel in a run is then a wrong
//! pixel everywhere. Each of them also has to survive a method that breaks. For example, a stress run calls
//! [`Judge::trial`] with a scene and some methods; if one of them panics, its [`Attempt`] says [`NoPicture::Failed`]
//! with the reason, and the others are drawn.
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
