//! The smallest slope bias of a shadow map without acne, and the detached shadow that it costs.

use super::FoundBias;
use crate::frame::PreparedMethod;
use crate::judge::{DeviceScene, Observer, Truth, Verifier};
use crate::methods::BiasSearch;
use crate::metrics::Label;
use crate::record::{BiasRow, Cell};

/// The first bias that is tried after none, in texels.
const FIRST_BIAS: f64 = 0.25;
/// The largest bias that is tried: it moves shadows by more than a hundred texels.
const LARGEST_BIAS: f64 = 128.0;
/// The bias is found to this part of it, or to this part of a texel, whichever is coarser.
const PRECISION: f64 = 1.0 / 16.0;
/// Acne in so large a part of a picture is none: a handful of pixels may have got the wrong label.
const TOLERANCE: f64 = 1e-5;
/// Pixels a frame at one bias.
#[derive(Clone, Copy)]
struct BiasTrial {
    slope_bias: f64,
    acne_px: f64,
    detached_px: f64,
}

/// Searches for the bias of one cell at `truths`; `None` if the user wants the run to stop.
///
/// # Errors
/// A [`crate::judge::NoPicture`] where the method cannot be made ready; else the device's.
pub(super) fn find(
    cell: &Cell,
    search: &BiasSearch<'_>,
    device: &DeviceScene<'_>,
    (verifier, truths): (&Verifier<'_>, &[Truth]),
    observer: &dyn Observer,
) -> anyhow::Result<Option<FoundBias>> {
    let mut tried = 0;
    let trial = |slope_bias: f64| {
        if observer.interrupted() {
            return Ok(None);
        }
        tried += 1;
        let mut ready = device.prepare((search.with_bias)(slope_bias).as_ref())?;
        try_bias(slope_bias, ready.method.as_mut(), verifier, truths).map(Some)
    };
    let tolerance_px = TOLERANCE * f64::from(cell.width) * f64::from(cell.height);
    let Some((unbiased, found)) = smallest(tolerance_px, trial)? else {
        return Ok(None);
    };
    Ok(Some(FoundBias {
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
    }))
}

/// No bias, and the smallest one that leaves no more acne than the largest does, for what no bias takes away
/// is none: doubles the bias until it is enough, then halves the gap to the last one that was not. Acne is
/// taken to become less as the bias grows; what is returned was tried.
fn smallest(
    tolerance_px: f64,
    mut trial: impl FnMut(f64) -> anyhow::Result<Option<BiasTrial>>,
) -> anyhow::Result<Option<(BiasTrial, BiasTrial)>> {
    let (Some(unbiased), Some(largest)) = (trial(0.0)?, trial(LARGEST_BIAS)?) else {
        return Ok(None);
    };
    let is_enough = |trial: BiasTrial| trial.acne_px <= largest.acne_px + tolerance_px;
    let (mut too_small, mut found) = (unbiased, unbiased);
    let mut next = FIRST_BIAS;
    while !is_enough(found) {
        too_small = found;
        found = if next < LARGEST_BIAS {
            let Some(tried) = trial(next)? else {
                return Ok(None);
            };
            tried
        } else {
            largest
        };
        next *= 2.0;
    }
    while found.slope_bias - too_small.slope_bias > PRECISION * found.slope_bias.max(1.0) {
        let Some(middle) = trial((found.slope_bias + too_small.slope_bias) / 2.0)? else {
            return Ok(None);
        };
        if is_enough(middle) {
            found = middle;
        } else {
            too_small = middle;
        }
    }
    Ok(Some((unbiased, found)))
}

fn try_bias(
    slope_bias: f64,
    prepared: &mut dyn PreparedMethod,
    verifier: &Verifier<'_>,
    truths: &[Truth],
) -> anyhow::Result<BiasTrial> {
    let (mut acne_px, mut detached_px) = (0, 0);
    for truth in truths {
        let mask = verifier.draw_mask(prepared, truth)?;
        let analysis = verifier.compare(&mask, truth, prepared)?.analysis;
        acne_px += analysis.label_px(Label::Acne);
        detached_px += analysis.label_px(Label::DetachedShadow);
    }
    let a_frame = |sum: u64| sum as f64 / truths.len().max(1) as f64;
    Ok(BiasTrial {
        slope_bias,
        acne_px: a_frame(acne_px),
        detached_px: a_frame(detached_px),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is found for so much acne at each bias, and how many biases were tried.
    fn found(acne_px: impl Fn(f64) -> f64) -> (f64, u32) {
        let mut tried = 0;
        let trial = |slope_bias| {
            tried += 1;
            Ok(Some(BiasTrial {
                slope_bias,
                acne_px: acne_px(slope_bias),
                detached_px: slope_bias,
            }))
        };
        let (unbiased, found) = smallest(1.0, trial).unwrap().unwrap();
        assert_eq!(unbiased.slope_bias, 0.0);
        assert_eq!(
            found.detached_px, found.slope_bias,
            "what is returned was tried"
        );
        (found.slope_bias, tried)
    }

    #[test]
    fn the_bias_at_which_acne_ends_is_found() {
        for end in [0.1, 0.9, 1.0, 3.3, 17.0, 127.0] {
            let (bias, tried) = found(|bias| 1000.0 * (end - bias).max(0.0));
            let precision = PRECISION * bias.max(1.0);
            assert!(
                bias > end - 0.01 && bias <= end + precision,
                "{end}: {bias}"
            );
            assert!(tried < 18, "{end}: {tried}");
        }
    }

    #[test]
    fn nothing_to_take_away_needs_no_bias() {
        assert_eq!(found(|_| 0.0), (0.0, 2));
        assert_eq!(found(|_| 70.0), (0.0, 2), "the same with any bias: no acne");
        assert_eq!(found(|bias| if bias == 0.0 { 0.9 } else { 0.0 }), (0.0, 2));
    }

    #[test]
    fn acne_that_comes_back_or_never_ends_ends_the_search() {
        let (bias, _) = found(|bias| {
            if bias > 2.0 && bias < 5.0 {
                50.0
            } else {
                400.0 - 3.2 * bias
            }
        });
        assert!(bias > 100.0, "{bias}");
        let (bias, _) = found(|bias| if bias < 128.0 { 9.0 } else { 0.0 });
        assert_eq!(bias, 128.0);
    }

    #[test]
    fn an_interrupted_search_finds_nothing() {
        assert!(smallest(1.0, |_| Ok(None)).unwrap().is_none());
    }
}
