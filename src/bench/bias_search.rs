//! The smallest slope bias of a shadow map without acne, and the detached shadow that it costs.

use super::Verifier;
use super::record::{BiasRow, Cell};
use crate::config::RunPlan;
use crate::methods::{BiasSearch, MethodError, PrepareContext};
use crate::metrics::Label;
use crate::scene::{CameraPath, View};

/// The first bias that is tried after none, in texels.
const FIRST_BIAS: f64 = 0.25;
/// Larger biases are not tried: they move shadows by more than a hundred texels.
const LARGEST_BIAS: f64 = 128.0;
/// The bias is found to this part of it, or to this many texels, whichever is coarser.
const PRECISION: f64 = 1.0 / 16.0;
/// Views of a run that verifies nothing.
const VIEWS: u32 = 3;

/// A bias that was found.
pub(super) struct FoundBias {
    /// In texels; the largest one tried where even that leaves acne.
    pub slope_bias: f64,
    /// How it was found.
    pub row: BiasRow,
}

/// Pixels a frame at one bias.
#[derive(Clone, Copy)]
struct Trial {
    slope_bias: f64,
    acne_px: f64,
    detached_px: f64,
}

/// The views at which biases are tried: the verified ones.
pub(super) fn views(plan: &RunPlan, camera: &CameraPath) -> Vec<View> {
    let mut times_s = plan.verified_times(camera);
    if times_s.is_empty() {
        times_s = camera.frame_times(VIEWS as usize);
    }
    times_s.into_iter().map(|s| camera.view_at(s)).collect()
}

/// Doubles the bias until there is no acne, then halves the gap to the last bias that left some. Acne is
/// taken to become less as the bias grows; a bias that was tried is never reported free of acne if it was not.
///
/// The outer error is the device's, the inner one the method's.
pub(super) fn find(
    cell: &Cell,
    search: &BiasSearch<'_>,
    context: &PrepareContext<'_>,
    verifier: &Verifier<'_>,
    views: &[View],
) -> anyhow::Result<Result<FoundBias, MethodError>> {
    let mut tried = 0;
    let mut attempt = |slope_bias: f64| -> anyhow::Result<Result<Trial, MethodError>> {
        tried += 1;
        try_bias(search, slope_bias, context, verifier, views)
    };
    let mut trial = |slope_bias| attempt(slope_bias);
    let unbiased = match trial(0.0)? {
        Ok(unbiased) => unbiased,
        Err(error) => return Ok(Err(error)),
    };
    let (mut with_acne, mut found) = (unbiased, unbiased);
    let mut next = FIRST_BIAS;
    while found.acne_px > 0.0 && next <= LARGEST_BIAS {
        with_acne = found;
        match trial(next)? {
            Ok(result) => found = result,
            Err(error) => return Ok(Err(error)),
        }
        next *= 2.0;
    }
    if found.acne_px == 0.0 {
        while found.slope_bias - with_acne.slope_bias > PRECISION * found.slope_bias.max(1.0) {
            let middle = (found.slope_bias + with_acne.slope_bias) / 2.0;
            match trial(middle)? {
                Ok(result) if result.acne_px > 0.0 => with_acne = result,
                Ok(result) => found = result,
                Err(error) => return Ok(Err(error)),
            }
        }
    }
    Ok(Ok(FoundBias {
        slope_bias: found.slope_bias,
        row: BiasRow {
            scene: cell.scene.clone(),
            method: cell.method.clone(),
            variant: cell.variant.clone(),
            resolution: search.resolution,
            slope_bias: (found.acne_px == 0.0).then_some(found.slope_bias),
            acne_px_unbiased: unbiased.acne_px,
            acne_px: found.acne_px,
            detached_px_unbiased: unbiased.detached_px,
            detached_px: found.detached_px,
            tried,
        },
    }))
}

fn try_bias(
    search: &BiasSearch<'_>,
    slope_bias: f64,
    context: &PrepareContext<'_>,
    verifier: &Verifier<'_>,
    views: &[View],
) -> anyhow::Result<Result<Trial, MethodError>> {
    let prepared = match (search.with_bias)(slope_bias).prepare(context) {
        Ok(prepared) => prepared,
        Err(error) => return Ok(Err(error)),
    };
    let (mut acne_px, mut detached_px) = (0, 0);
    for view in views {
        let truth = verifier.truth(view)?;
        let mask = verifier.draw_mask(prepared.as_ref(), &truth)?;
        let analysis = verifier.judge(&mask, &truth, prepared.as_ref())?.analysis;
        acne_px += analysis.label_px(Label::Acne);
        detached_px += analysis.label_px(Label::DetachedShadow);
    }
    let a_frame = |sum: u64| sum as f64 / views.len().max(1) as f64;
    Ok(Ok(Trial {
        slope_bias,
        acne_px: a_frame(acne_px),
        detached_px: a_frame(detached_px),
    }))
}
