//! The smallest slope bias of a shadow map without acne, and the detached shadow that it costs.

use super::Verifier;
use super::record::{BiasRow, Cell};
use super::verify::Truth;
use crate::config::RunPlan;
use crate::methods::{BiasSearch, PrepareContext, PreparedMethod};
use crate::metrics::Label;
use crate::scene::{CameraPath, View};

/// The first bias that is tried after none, in texels.
const FIRST_BIAS: f64 = 0.25;
/// The largest bias that is tried: it moves shadows by more than a hundred texels. A power of two times the
/// first, so that doubling ends there.
const LARGEST_BIAS: f64 = 128.0;
/// The bias is found to this part of it, or to this many texels, whichever is coarser.
const PRECISION: f64 = 1.0 / 16.0;
/// Views of a run that verifies nothing.
const VIEWS: u32 = 3;

/// A bias that was found.
pub(super) struct FoundBias {
    /// In texels.
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

/// The smallest bias that leaves no more acne than the largest one, for what no bias takes away is none:
/// doubles the bias until it does, then halves the gap to the last one that did not. Acne is taken to become
/// less as the bias grows; what is reported was tried.
///
/// # Errors
/// A [`crate::methods::MethodError`] where the method cannot run here; else the device's.
pub(super) fn find(
    cell: &Cell,
    search: &BiasSearch<'_>,
    context: &PrepareContext<'_>,
    verifier: &Verifier<'_>,
    views: &[View],
) -> anyhow::Result<FoundBias> {
    let truths = views
        .iter()
        .map(|view| verifier.truth(view))
        .collect::<anyhow::Result<Vec<_>>>()?;
    let mut tried = 0;
    let mut trial = |slope_bias: f64| {
        tried += 1;
        let prepared = (search.with_bias)(slope_bias).prepare(context)?;
        try_bias(slope_bias, prepared.as_ref(), verifier, &truths)
    };
    let unbiased = trial(0.0)?;
    let largest = trial(LARGEST_BIAS)?;
    let is_enough = |trial: Trial| trial.acne_px <= largest.acne_px;
    let (mut too_small, mut found) = (unbiased, unbiased);
    let mut next = FIRST_BIAS;
    while !is_enough(found) {
        too_small = found;
        found = trial(next)?;
        next *= 2.0;
    }
    let is_coarse = |low: Trial, high: Trial| {
        high.slope_bias - low.slope_bias > PRECISION * high.slope_bias.max(1.0)
    };
    while is_coarse(too_small, found) {
        let middle = trial((found.slope_bias + too_small.slope_bias) / 2.0)?;
        if is_enough(middle) {
            found = middle;
        } else {
            too_small = middle;
        }
    }
    Ok(FoundBias {
        slope_bias: found.slope_bias,
        row: BiasRow {
            scene: cell.scene.clone(),
            method: cell.method.clone(),
            variant: cell.variant.clone(),
            resolution: search.resolution,
            slope_bias: found.slope_bias,
            acne_px_unbiased: unbiased.acne_px,
            acne_px: found.acne_px,
            detached_px_unbiased: unbiased.detached_px,
            detached_px: found.detached_px,
            tried,
        },
    })
}

fn try_bias(
    slope_bias: f64,
    prepared: &dyn PreparedMethod,
    verifier: &Verifier<'_>,
    truths: &[Truth],
) -> anyhow::Result<Trial> {
    let (mut acne_px, mut detached_px) = (0, 0);
    for truth in truths {
        let mask = verifier.draw_mask(prepared, truth)?;
        let analysis = verifier.judge(&mask, truth, prepared)?.analysis;
        acne_px += analysis.label_px(Label::Acne);
        detached_px += analysis.label_px(Label::DetachedShadow);
    }
    let a_frame = |sum: u64| sum as f64 / truths.len().max(1) as f64;
    Ok(Trial {
        slope_bias,
        acne_px: a_frame(acne_px),
        detached_px: a_frame(detached_px),
    })
}
