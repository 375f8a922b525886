//! How right a mask or a picture is.

use super::{Truth, Verifier};
use crate::frame::PreparedMethod;
use crate::metrics::{
    Analysis, Distances, Flicker, FrameContext, MaskComparison, MaskError, analyse, mean_flip,
};
use crate::reference::{BoundaryProbe, Motion, ReferenceMask, Verdict};

/// How a method did at one view.
pub struct Judgement {
    /// Counts of wrong pixels.
    pub error: MaskError,
    /// How far they are from the true edge.
    pub distances: Distances,
    /// What kind of errors they are.
    pub analysis: Analysis,
    /// RGB, rows from the top: where they are.
    pub error_map: Vec<u8>,
}

impl Verifier<'_> {
    /// Compares a mask with the truth of the same view. `method`, which drew it, may know its shadow map's
    /// texels.
    ///
    /// # Errors
    /// When mask and truth differ in size.
    pub fn compare(
        &self,
        mask: &[u8],
        truth: &Truth,
        method: &dyn PreparedMethod,
    ) -> anyhow::Result<Judgement> {
        let light = truth.moment.light;
        let wrong_px = wrong_px(mask, &truth.mask);
        let probe = BoundaryProbe::new(&self.reference, light, &truth.view, &truth.mask, wrong_px)?;
        let comparison = MaskComparison::new(mask, &truth.mask, |x, y| probe.near_boundary(x, y))?;
        let texels = method.texels();
        let context = FrameContext {
            reference: &self.reference,
            light,
            view: &truth.view,
            triangle_ids: &truth.triangle_ids,
            edges: &truth.edges,
            texel: texels.as_ref().map(|texels| &*texels.of as _),
            texel_reach: texels.as_ref().map_or(0, |texels| texels.reach),
        };
        Ok(Judgement {
            error: comparison.error(),
            distances: comparison.distances(&truth.edges),
            analysis: analyse(&comparison, &context)?,
            error_map: comparison.error_map(),
        })
    }

    /// Mean FLIP of a picture of the frame against the one with the true shadows, RGBA: 0 alike to 1.
    /// Ambiguous pixels are taken to be right.
    ///
    /// # Errors
    /// When they differ in size.
    pub fn flip(&self, truth: &Truth, true_picture: &[u8], picture: &[u8]) -> anyhow::Result<f64> {
        let mut expected = true_picture.to_vec();
        let pixels = expected.chunks_exact_mut(4).zip(picture.chunks_exact(4));
        for ((expected, found), verdict) in pixels.zip(truth.mask.verdicts()) {
            if verdict == Verdict::Ambiguous {
                expected.copy_from_slice(found);
            }
        }
        let size = [self.resources.targets.width, self.resources.targets.height];
        Ok(mean_flip(size, &expected, picture)?)
    }
}

/// Pixels that are wrong, wherever.
fn wrong_px(mask: &[u8], truth: &ReferenceMask) -> usize {
    let is_wrong = |(value, verdict): &(&u8, Verdict)| {
        MaskComparison::is_shadowed(**value) != (*verdict == Verdict::Shadowed)
    };
    mask.iter().zip(truth.verdicts()).filter(is_wrong).count()
}

/// Which errors of a method's masks come or go from one view to the next.
///
/// # Errors
/// When a mask and its truth differ in size.
pub(crate) fn flicker(
    motion: &Motion,
    (mask, truth): (&[u8], &Truth),
    (next_mask, next): (&[u8], &Truth),
) -> anyhow::Result<Flicker> {
    // How far an error is from the edge does not matter here.
    let before = MaskComparison::new(mask, &truth.mask, |_, _| true)?;
    let after = MaskComparison::new(next_mask, &next.mask, |_, _| true)?;
    Ok(Flicker::between(motion, &before, &after))
}
