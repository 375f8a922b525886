//! What is measured of a method beside its pictures: [`METRICS`], and what they are computed from.
//!
//! [`MaskComparison`] holds a method's mask against the reference, pixel by pixel; [`MaskError`]
//! is the sum of it, and [`MaskComparison::error_map`] its picture. [`Distances`] tells how far from
//! the true edge the errors are, [`analyse`] what kind of errors they are, [`Flicker`] how they come
//! and go in time, and [`mean_flip`] how much of it all a person would see.

mod catalogue;
mod distances;
mod error_map;
mod flicker;
mod flip;
mod label;
mod labels;
mod mask_error;
mod metric;
mod regions;

#[cfg(test)]
mod analytic_tests;
#[cfg(test)]
mod shot;

pub use catalogue::METRICS;
pub use distances::{DISTANCE_LIMITS_PX, Distances, EdgeDistances};
pub use error_map::{
    AMBIGUOUS_RGB, FALSE_LIT_ARTIFACT_RGB, FALSE_LIT_BOUNDARY_RGB, FALSE_SHADOWED_ARTIFACT_RGB,
    FALSE_SHADOWED_BOUNDARY_RGB,
};
pub use flicker::Flicker;
pub use flip::{PictureSizeError, mean_flip};
pub use label::Label;
pub use labels::{Analysis, FrameContext, SEAM_STEPS, TexelLookup, analyse};
pub use mask_error::{
    MaskComparison, MaskError, MaskSizeError, PixelResult, Place, SHADOWED_FROM, undecided,
};
pub use metric::{Compute, Findings, Metric, MetricValues, OverFrames, find_metric};
pub use regions::{Region, Sign};
