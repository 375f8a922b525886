//! Questions about single pixels and points.

use super::{Truth, Verifier};
use crate::metrics::{MaskComparison, SEAM_STEPS};
use crate::reference::{BoundaryProbe, Motion, Verdict};
use rayon::prelude::*;

/// What is true of one pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelTruth {
    /// The triangle that it shows.
    pub triangle: Option<u32>,
    /// Whether that is in shadow there.
    pub verdict: Verdict,
    /// Whether the true shadow boundary passes within a pixel of its centre.
    pub at_boundary: bool,
    /// Whether an edge of the triangle passes it as near as at a [`crate::metrics::Label::Seam`].
    pub at_seam: bool,
}

impl Verifier<'_> {
    /// What is true of some pixels, which are counted by rows from the top.
    ///
    /// # Errors
    /// When the view is no perspective.
    pub fn look(&self, truth: &Truth, pixels: &[usize]) -> anyhow::Result<Vec<PixelTruth>> {
        let (reference, mask) = (&self.reference, &truth.mask);
        let probe = BoundaryProbe::new(
            reference,
            truth.moment.light,
            &truth.view,
            mask,
            pixels.len(),
        )?;
        let evidence = reference.evidence(truth.moment.light, &truth.view, &truth.triangle_ids)?;
        let look = |&pixel: &usize| PixelTruth {
            triangle: truth.triangle_ids[pixel].checked_sub(1),
            verdict: mask.verdict(pixel),
            at_boundary: probe.near_boundary(pixel as u32 % mask.width, pixel as u32 / mask.width),
            at_seam: evidence.at_inner_edge(pixel, SEAM_STEPS),
        };
        Ok(pixels.iter().map(look).collect())
    }

    /// The pixels of a mask that are wrong although the truth is the same all around their centre, counted by
    /// rows from the top: no tie excuses them, be they [ambiguous](Verdict::Ambiguous) or not.
    ///
    /// # Errors
    /// When the view is no perspective.
    pub fn hard_errors(&self, mask: &[u8], truth: &Truth) -> anyhow::Result<Vec<usize>> {
        let probe = self
            .reference
            .surroundings(truth.moment.light, &truth.view)?;
        let width = truth.mask.width;
        let is_hard = |pixel: &usize| {
            let is_shadowed = MaskComparison::is_shadowed(mask[*pixel]);
            let verdict = truth.mask.verdict(*pixel);
            let differs = |verdict| is_shadowed != (verdict == Verdict::Shadowed);
            (verdict == Verdict::Ambiguous || differs(verdict)) && {
                let (x, y) = (*pixel as u32 % width, *pixel as u32 / width);
                probe
                    .drawn(x, y, truth.triangle_ids[*pixel])
                    .is_some_and(differs)
                    && probe.unanimous(x, y).is_some_and(differs)
            }
        };
        let pixels = (0..mask.len()).into_par_iter();
        Ok(pixels.filter(is_hard).collect())
    }

    /// Where the surface points seen at one view appear at another.
    ///
    /// # Errors
    /// When a view is no perspective.
    pub fn motion(&self, from: &Truth, to: &Truth) -> anyhow::Result<Motion> {
        let from = (&from.view, &from.triangle_ids[..]);
        let to = (&to.view, &to.triangle_ids[..]);
        Ok(self.reference.follow(from, to)?)
    }
}
