//! What is true of a whole mask: it is inverted, or moved by a pixel.

use crate::metrics::Label;
use crate::metrics::mask_error::MaskComparison;
use crate::reference::Verdict;

/// Inverted: at least this share of the lit pixels is wrong, and of those in shadow. A mask that is
/// all lit or all in shadow is not, unless the truth is the opposite everywhere.
const INVERTED_SHARE: f64 = 0.9;

/// Offset: at most this share of the wrong pixels stays wrong when the mask is moved back.
const OFFSET_REMAINDER: f64 = 0.1;

/// Fewer wrong pixels than this are no evidence of an offset.
const OFFSET_MIN_PX: usize = 16;

/// The label that holds for all wrong pixels, if there is one.
pub(super) fn whole_frame(comparison: &MaskComparison<'_>) -> Option<Label> {
    if is_inverted(comparison) {
        Some(Label::Inverted)
    } else if is_offset(comparison) {
        Some(Label::Offset)
    } else {
        None
    }
}

fn is_inverted(comparison: &MaskComparison<'_>) -> bool {
    let (mut surface, mut wrong) = ([0u64; 2], [0u64; 2]);
    for (verdict, result) in comparison.truth.verdicts().zip(comparison.results()) {
        let side = match verdict {
            Verdict::Lit => 0,
            Verdict::Shadowed => 1,
            Verdict::Background | Verdict::Ambiguous => continue,
        };
        surface[side] += 1;
        wrong[side] += u64::from(result.wrong_place().is_some());
    }
    let turned = |side: usize| wrong[side] as f64 >= INVERTED_SHARE * surface[side] as f64;
    surface.iter().sum::<u64>() > 0 && turned(0) && turned(1)
}

fn is_offset(comparison: &MaskComparison<'_>) -> bool {
    let results = comparison.results().iter();
    let wrong = results
        .filter(|result| result.wrong_place().is_some())
        .count();
    if wrong < OFFSET_MIN_PX {
        return false;
    }
    let limit = (OFFSET_REMAINDER * wrong as f64) as usize;
    (-1..=1)
        .flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)))
        .filter(|&step| step != (0, 0))
        .any(|step| wrong_when_moved(comparison, step).nth(limit).is_none())
}

/// Pixels where the mask is wrong once it is moved by `(dx, dy)`. What moves in from outside of the
/// picture, or from where the reference cannot decide, is not compared.
fn wrong_when_moved(
    comparison: &MaskComparison<'_>,
    (dx, dy): (i64, i64),
) -> impl Iterator<Item = usize> {
    let (width, height) = (
        i64::from(comparison.width()),
        i64::from(comparison.height()),
    );
    (0..comparison.results().len()).filter(move |&pixel| {
        let (x, y) = (pixel as i64 % width - dx, pixel as i64 / width - dy);
        if !(0..width).contains(&x) || !(0..height).contains(&y) {
            return false;
        }
        let truth = match comparison.truth.verdict(pixel) {
            Verdict::Ambiguous => return false,
            verdict => verdict == Verdict::Shadowed,
        };
        let moved = comparison.shadowed((y * width + x) as usize);
        moved.is_some_and(|shadowed| shadowed != truth)
    })
}
