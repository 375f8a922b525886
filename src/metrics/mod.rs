//! What is measured of a method beside its pictures: one file a metric.
//!
//! [`MaskComparison`] holds a method's mask against the reference, pixel by pixel; [`MaskError`]
//! is the sum of it, and [`MaskComparison::error_map`] its picture.

mod error_map;
mod mask_error;

pub use error_map::{
    AMBIGUOUS_RGB, FALSE_LIT_ARTIFACT_RGB, FALSE_LIT_BOUNDARY_RGB, FALSE_SHADOWED_ARTIFACT_RGB,
    FALSE_SHADOWED_BOUNDARY_RGB,
};
pub use mask_error::{MaskComparison, MaskError, MaskSizeError, PixelResult, Place};
