//! Hours of sun per pixel: of the truth, and of a method against it.

use crate::metrics::MaskComparison;
use crate::reference::{ReferenceMask, Verdict};

/// A difference below this part of a step is rounding.
const ROUNDING: f64 = 1e-4;

/// Hours of sun by the truth. What the truth cannot tell is kept apart.
#[derive(Clone, Debug)]
pub struct TrueHours {
    /// For certain, of each pixel, by rows from the top.
    pub lit_h: Vec<f32>,
    /// Undecided, of each pixel.
    pub doubt_h: Vec<f32>,
    /// Whether a pixel shows a surface.
    pub is_surface: Vec<bool>,
}

/// Pixels of one picture, of those that show a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PixelCounts {
    /// In the sun.
    pub lit: u64,
    /// In shadow.
    pub shadowed: u64,
    /// The truth cannot tell.
    pub ambiguous: u64,
}

impl PixelCounts {
    /// The sunny part of what is decided; 0 where nothing is.
    #[must_use]
    pub fn lit_share(&self) -> f64 {
        self.lit as f64 / (self.lit + self.shadowed).max(1) as f64
    }
}

impl TrueHours {
    /// No sun yet on what this picture shows.
    #[must_use]
    pub fn new(truth: &ReferenceMask) -> Self {
        let is_surface: Vec<bool> = truth.verdicts().map(Verdict::is_surface).collect();
        Self {
            lit_h: vec![0.0; is_surface.len()],
            doubt_h: vec![0.0; is_surface.len()],
            is_surface,
        }
    }

    /// Adds a picture that stands for `hours`.
    pub fn add(&mut self, hours: f64, truth: &ReferenceMask) -> PixelCounts {
        let mut counts = PixelCounts::default();
        for (pixel, verdict) in truth.verdicts().enumerate() {
            match verdict {
                Verdict::Background => {}
                Verdict::Shadowed => counts.shadowed += 1,
                Verdict::Lit => {
                    counts.lit += 1;
                    self.lit_h[pixel] += hours as f32;
                }
                Verdict::Ambiguous => {
                    counts.ambiguous += 1;
                    self.doubt_h[pixel] += hours as f32;
                }
            }
        }
        counts
    }

    /// Pixels that show a surface, all in shadow: a picture of the night.
    #[must_use]
    pub fn night(&self) -> PixelCounts {
        let surfaces = self.is_surface.iter().filter(|is_surface| **is_surface);
        PixelCounts {
            shadowed: surfaces.count() as u64,
            ..PixelCounts::default()
        }
    }

    /// The hours of each pixel, in the middle of what they may be; `None` where it shows no surface.
    pub fn hours(&self) -> impl Iterator<Item = Option<f32>> {
        let known = self.lit_h.iter().zip(&self.doubt_h).zip(&self.is_surface);
        known.map(|((lit, doubt), is_surface)| is_surface.then_some(lit + doubt / 2.0))
    }
}

/// Hours of sun by a method, and how far they are from the truth.
///
/// Steps that the truth cannot decide at a pixel are left out of the pixel's error, on both sides, and their hours
/// are stated beside it.
#[derive(Clone, Debug)]
pub struct MethodHours {
    /// Of each pixel, by rows from the top.
    pub lit_h: Vec<f32>,
    /// Hours by the method less hours by the truth, of what the truth can decide.
    pub error_h: Vec<f32>,
    /// Hours that the truth cannot decide.
    doubt_h: Vec<f32>,
    is_surface: Vec<bool>,
}

/// How far a method's minutes of sun are from the truth, over the pixels that show a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MinutesError {
    /// On average.
    pub mean_minutes: f64,
    /// Of 95 in 100 pixels no more than this.
    pub p95_minutes: f64,
    /// At the worst pixel.
    pub worst_minutes: f64,
    /// The part of the pixels whose hours agree with the truth's within one step.
    pub within_step_share: f64,
    /// Pixels that show a surface.
    pub surface_px: u64,
    /// Of these, those with a step that the truth cannot decide.
    pub ambiguous_px: u64,
    /// Undecided minutes, on average over all pixels that show a surface.
    pub ambiguous_minutes_mean: f64,
}

impl MethodHours {
    /// No sun yet on what this picture shows.
    #[must_use]
    pub fn new(truth: &ReferenceMask) -> Self {
        let TrueHours {
            lit_h,
            doubt_h,
            is_surface,
        } = TrueHours::new(truth);
        Self {
            error_h: lit_h.clone(),
            lit_h,
            doubt_h,
            is_surface,
        }
    }

    /// Adds a mask that stands for `hours`, and the truth of the same picture.
    pub fn add(&mut self, hours: f64, mask: &[u8], truth: &ReferenceMask) {
        let hours = hours as f32;
        for (pixel, (&value, verdict)) in mask.iter().zip(truth.verdicts()).enumerate() {
            if !verdict.is_surface() {
                continue;
            }
            let lit_h = match MaskComparison::is_shadowed(value) {
                true => 0.0,
                false => hours,
            };
            self.lit_h[pixel] += lit_h;
            match verdict {
                Verdict::Lit => self.error_h[pixel] += lit_h - hours,
                Verdict::Shadowed => self.error_h[pixel] += lit_h,
                Verdict::Ambiguous => self.doubt_h[pixel] += hours,
                Verdict::Background => {}
            }
        }
    }

    /// The hours of each pixel; `None` where it shows no surface.
    pub fn hours(&self) -> impl Iterator<Item = Option<f32>> {
        let known = self.lit_h.iter().zip(&self.is_surface);
        known.map(|(hours, is_surface)| is_surface.then_some(*hours))
    }

    /// How far all of it is from the truth, in steps of `step_h`.
    #[must_use]
    pub fn error(&self, step_h: f64) -> MinutesError {
        let of_surfaces = |values: &[f32]| -> Vec<f64> {
            let pixels = values.iter().zip(&self.is_surface);
            pixels
                .filter(|(_, is_surface)| **is_surface)
                .map(|(value, _)| f64::from(value.abs()))
                .collect()
        };
        let mut errors_h = of_surfaces(&self.error_h);
        if errors_h.is_empty() {
            return MinutesError::default();
        }
        errors_h.sort_by(f64::total_cmp);
        let doubts_h = of_surfaces(&self.doubt_h);
        let count = errors_h.len() as f64;
        let within = errors_h.partition_point(|error| *error <= step_h * (1.0 + ROUNDING));
        // The nearest rank.
        let p95 = (0.95 * count).ceil() as usize - 1;
        let mean_minutes = |hours: &[f64]| 60.0 * hours.iter().sum::<f64>() / count;
        MinutesError {
            mean_minutes: mean_minutes(&errors_h),
            p95_minutes: 60.0 * errors_h[p95],
            worst_minutes: 60.0 * errors_h.last().copied().unwrap_or_default(),
            within_step_share: within as f64 / count,
            surface_px: errors_h.len() as u64,
            ambiguous_px: doubts_h.iter().filter(|doubt| **doubt > 0.0).count() as u64,
            ambiguous_minutes_mean: mean_minutes(&doubts_h),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::fixtures::of_verdicts;
    use Verdict::{Ambiguous, Background, Lit, Shadowed};

    fn truth(verdicts: [Verdict; 5]) -> ReferenceMask {
        of_verdicts(5, 1, verdicts.to_vec())
    }

    #[test]
    fn hours_add_up_and_doubts_stay_apart() {
        let first = truth([Background, Lit, Shadowed, Ambiguous, Lit]);
        let second = truth([Background, Lit, Lit, Shadowed, Ambiguous]);
        let mut hours = TrueHours::new(&first);
        let counts = hours.add(0.25, &first);
        assert_eq!((counts.lit, counts.shadowed, counts.ambiguous), (2, 1, 1));
        assert!((counts.lit_share() - 2.0 / 3.0).abs() < 1e-12);
        hours.add(0.5, &second);
        let of_pixels: Vec<_> = hours.hours().collect();
        assert_eq!(
            of_pixels,
            [None, Some(0.75), Some(0.5), Some(0.125), Some(0.5)]
        );
        assert_eq!(hours.doubt_h, [0.0, 0.0, 0.0, 0.25, 0.5]);
        assert_eq!((hours.night().lit, hours.night().shadowed), (0, 4));
    }

    #[test]
    fn errors_are_minutes_and_leave_out_what_is_undecided() {
        let first = truth([Background, Lit, Shadowed, Ambiguous, Lit]);
        let mut hours = MethodHours::new(&first);
        // Wrong at the last pixel, and at the background, which does not count.
        hours.add(0.5, &[255, 0, 255, 0, 255], &first);
        // Wrong at the second and the last but one.
        hours.add(
            0.5,
            &[0, 0, 0, 0, 0],
            &truth([Background, Lit, Shadowed, Shadowed, Lit]),
        );
        assert_eq!(hours.error_h, [0.0, 0.0, 0.5, 0.5, -0.5]);
        assert_eq!(
            hours.hours().collect::<Vec<_>>()[1..],
            [Some(1.0), Some(0.5), Some(1.0), Some(0.5)]
        );
        let error = hours.error(0.5);
        assert_eq!((error.surface_px, error.ambiguous_px), (4, 1));
        assert_eq!((error.mean_minutes, error.worst_minutes), (22.5, 30.0));
        assert_eq!(
            (error.p95_minutes, error.ambiguous_minutes_mean),
            (30.0, 7.5)
        );
        assert_eq!(error.within_step_share, 1.0);
        assert_eq!(hours.error(0.25).within_step_share, 0.25);
    }

    #[test]
    fn errors_of_two_signs_cancel_within_a_pixel_as_hours_do() {
        let lit = truth([Lit; 5]);
        let dark = truth([Shadowed; 5]);
        let mut hours = MethodHours::new(&lit);
        hours.add(1.0, &[255; 5], &lit);
        hours.add(1.0, &[0; 5], &dark);
        assert_eq!(hours.error(1.0).worst_minutes, 0.0);
    }

    #[test]
    fn a_picture_of_nothing_has_no_errors() {
        let nothing = truth([Background; 5]);
        assert_eq!(
            MethodHours::new(&nothing).error(1.0),
            MinutesError::default()
        );
    }
}
