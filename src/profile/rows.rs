//! The rows of a profile's tables.

use serde::Serialize;

use super::day::{Day, Step};
use super::hours::{MinutesError, PixelCounts};
use crate::judge::NoPicture;
use crate::methods::ShadowMethod;
use crate::variant::Variant;

/// A row of `hours.csv`: one step of the day, by the truth.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HourRow {
    /// RFC 3339, in universal time.
    pub time: String,
    /// What clocks show.
    pub local_time: String,
    /// How much of the day the step stands for.
    pub minutes: f64,
    /// Clockwise from north.
    pub sun_azimuth_deg: f64,
    /// Above the horizon, with refraction.
    pub sun_elevation_deg: f64,
    /// Pixels in the sun.
    pub lit_px: u64,
    /// Pixels in shadow; at night, all that show a surface.
    pub shadowed_px: u64,
    /// Pixels that the truth cannot decide.
    pub ambiguous_px: u64,
    /// The sunny part of the surface that is seen, of what is decided.
    pub lit_share: f64,
}

impl HourRow {
    pub(super) fn new(day: &Day, step: &Step, counts: PixelCounts) -> Self {
        Self {
            time: step.time.to_string(),
            local_time: day.clock(step),
            minutes: 60.0 * step.hours,
            sun_azimuth_deg: step.position.azimuth_deg,
            sun_elevation_deg: step.position.elevation_deg,
            lit_px: counts.lit,
            shadowed_px: counts.shadowed,
            ambiguous_px: counts.ambiguous,
            lit_share: counts.lit_share(),
        }
    }
}

/// A row of `methods.csv`: how far a method's minutes of sun are from the truth. Without a picture there are no
/// numbers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodRow {
    /// Id.
    pub method: String,
    /// Parameters that differ from the defaults.
    pub variant: Variant,
    /// `ok`, `unavailable` or `failed`.
    pub status: &'static str,
    /// On average over the pixels that show a surface.
    pub error_minutes_mean: Option<f64>,
    /// Of 95 in 100 pixels no more than this.
    pub error_minutes_p95: Option<f64>,
    /// At the worst pixel.
    pub error_minutes_worst: Option<f64>,
    /// The part of the pixels that agree with the truth within one step.
    pub within_step_share: Option<f64>,
    /// Pixels that show a surface.
    pub surface_px: Option<u64>,
    /// Of these, those with a step that the truth cannot decide, which is left out of their error.
    pub ambiguous_px: Option<u64>,
    /// Minutes that the truth cannot decide, on average over the pixels that show a surface.
    pub ambiguous_minutes_mean: Option<f64>,
    /// Why there is no picture.
    pub reason: String,
}

impl MethodRow {
    pub(super) fn new(method: &dyn ShadowMethod, error: Result<MinutesError, NoPicture>) -> Self {
        let (status, reason) = match &error {
            Ok(_) => ("ok", String::new()),
            Err(NoPicture::Unavailable(reason)) => ("unavailable", reason.clone()),
            Err(NoPicture::Failed(reason)) => ("failed", reason.clone()),
        };
        let error = error.ok();
        Self {
            method: method.info().id.to_owned(),
            variant: method.variant(),
            status,
            error_minutes_mean: error.map(|error| error.mean_minutes),
            error_minutes_p95: error.map(|error| error.p95_minutes),
            error_minutes_worst: error.map(|error| error.worst_minutes),
            within_step_share: error.map(|error| error.within_step_share),
            surface_px: error.map(|error| error.surface_px),
            ambiguous_px: error.map(|error| error.ambiguous_px),
            ambiguous_minutes_mean: error.map(|error| error.ambiguous_minutes_mean),
            reason,
        }
    }

    /// The method with its parameters.
    #[must_use]
    pub fn name(&self) -> String {
        match self.variant.is_empty() {
            true => self.method.clone(),
            false => format!("{},{}", self.method, self.variant.as_str()),
        }
    }
}
