//! Where the true shadow boundary runs, finer than a pixel: asked of wrong pixels only.

use glam::DVec2;
use std::sync::atomic::{AtomicU8, Ordering};

use super::segment::ExactLight;
use super::view::Projection;
use super::{Reference, ReferenceError, ReferenceMask, ReferenceView, Verdict};
use crate::scene::Light;

/// Samples along a pixel's side. A shadow thinner than a quarter of a pixel may go unseen.
const FINE_PER_PX: i64 = 4;
/// The same where so much is asked that it would take seconds, and single pixels matter little.
const COARSE_PER_PX: i64 = 2;
/// More questions than this are many.
const MANY_PX: usize = 20_000;

/// Answers whether the true shadow boundary passes within one pixel of a pixel's centre (in the
/// square of two pixels by two around it).
///
/// A shadow may be thinner than a pixel, so verdicts at pixel centres are not enough: where they
/// all agree, the surface is sampled on a lattice of a quarter of a pixel. What is learnt is kept,
/// since wrong pixels come in clusters and their squares overlap.
pub struct BoundaryProbe<'a> {
    reference: &'a Reference,
    light: ExactLight,
    projection: Projection,
    truth: &'a ReferenceMask,
    samples_per_px: i64,
    /// The lattice, by rows; 0 where not yet sampled.
    samples: Vec<AtomicU8>,
}

impl<'a> BoundaryProbe<'a> {
    /// A probe for the picture that `truth` was traced for, to be asked of at most `wrong_px` pixels: of
    /// many, it samples half a pixel apart instead of a quarter.
    ///
    /// # Errors
    /// As [`Reference::trace`].
    pub fn new(
        reference: &'a Reference,
        light: Light,
        view: &ReferenceView,
        truth: &'a ReferenceMask,
        wrong_px: usize,
    ) -> Result<Self, ReferenceError> {
        let (expected, found) = (view.pixel_count(), truth.visibility.len());
        if (truth.width, truth.height) != (view.width, view.height) || expected != found {
            return Err(ReferenceError::WrongSize { expected, found });
        }
        let (light, projection) = (ExactLight::new(light)?, Projection::new(view)?);
        let samples_per_px = if wrong_px > MANY_PX {
            COARSE_PER_PX
        } else {
            FINE_PER_PX
        };
        let samples_len = expected * (samples_per_px * samples_per_px) as usize;
        let samples = (0..samples_len).map(|_| AtomicU8::new(0)).collect();
        Ok(Self {
            reference,
            light,
            projection,
            truth,
            samples_per_px,
            samples,
        })
    }

    /// Whether the true shadow boundary passes within one pixel of the centre of this pixel.
    ///
    /// Never at a background pixel: the outline of the geometry is no shadow boundary.
    #[must_use]
    pub fn near_boundary(&self, x: u32, y: u32) -> bool {
        let (column, row) = (i64::from(x), i64::from(y));
        let Some(centre) = self.truth.get(column, row).filter(|v| v.is_surface()) else {
            return false;
        };
        if self.truth.boundary_among_neighbours(x, y) {
            return true;
        }
        // The pixel's own samples and half of each neighbour's.
        let per_px = self.samples_per_px;
        let reach = per_px / 2;
        let span = |pixel: i64| pixel * per_px - reach..(pixel + 1) * per_px + reach;
        span(row).any(|j| {
            span(column).any(|i| {
                self.sample(i, j)
                    .is_some_and(|v| v.is_surface() && v != centre)
            })
        })
    }

    /// The verdict at a point of the lattice, or `None` outside the picture.
    fn sample(&self, i: i64, j: i64) -> Option<Verdict> {
        let per_px = self.samples_per_px;
        let columns = i64::from(self.truth.width) * per_px;
        let rows = i64::from(self.truth.height) * per_px;
        if !(0..columns).contains(&i) || !(0..rows).contains(&j) {
            return None;
        }
        // Relaxed: two threads may both trace a sample, and will store the same.
        let slot = &self.samples[(j * columns + i) as usize];
        if let Some(verdict) = decode(slot.load(Ordering::Relaxed)) {
            return Some(verdict);
        }
        let place_px = DVec2::new(i as f64 + 0.5, j as f64 + 0.5) / per_px as f64;
        let verdict = self
            .reference
            .verdict_at(&self.projection, place_px, self.light);
        slot.store(encode(verdict), Ordering::Relaxed);
        Some(verdict)
    }
}

const VERDICTS: [Verdict; 4] = [
    Verdict::Background,
    Verdict::Lit,
    Verdict::Shadowed,
    Verdict::Ambiguous,
];

fn encode(verdict: Verdict) -> u8 {
    verdict as u8 + 1
}

fn decode(byte: u8) -> Option<Verdict> {
    VERDICTS.get(usize::from(byte).checked_sub(1)?).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_samples_round_trip() {
        assert_eq!(decode(0), None);
        assert!(
            VERDICTS
                .into_iter()
                .all(|verdict| decode(encode(verdict)) == Some(verdict))
        );
    }
}
