use super::*;
use crate::reference::fixtures::{of_verdicts, visibility};
use std::sync::atomic::{AtomicU32, Ordering};

const SIZE: u32 = 32;

/// A picture of geometry below row 4, with a square shadow in its middle.
fn truth() -> ReferenceMask {
    let verdict = |pixel: u32| match (pixel % SIZE, pixel / SIZE) {
        (_, 0..4) => Verdict::Background,
        (8..24, 12..24) => Verdict::Shadowed,
        _ => Verdict::Lit,
    };
    of_verdicts(SIZE, SIZE, (0..SIZE * SIZE).map(verdict).collect())
}

fn error(mask: &[u8]) -> MaskError {
    MaskComparison::new(mask, &truth(), |_, _| false)
        .unwrap()
        .error()
}

#[test]
fn an_exact_mask_has_no_error() {
    let compared_px = u64::from(SIZE * SIZE);
    assert_eq!(
        error(&truth().to_grey()),
        MaskError {
            compared_px,
            ..MaskError::default()
        }
    );
}

#[test]
fn a_mask_shifted_by_a_pixel_is_wrong_at_the_boundary_only() {
    let mut mask = truth().to_grey();
    mask.rotate_right(1);
    let error = error(&mask);
    assert_eq!((error.false_lit, error.false_shadowed), (12, 12));
    assert_eq!((error.boundary_px, error.artifact_px), (24, 0));
}

#[test]
fn an_inverted_mask_is_mostly_artifact() {
    let mask: Vec<u8> = truth().to_grey().iter().map(|grey| 255 - grey).collect();
    let error = error(&mask);
    assert_eq!(error.wrong_px(), u64::from(SIZE * SIZE));
    // The shadow's outline: 16 + 16 + 10 + 10 inside it, 18 + 18 + 12 + 12 outside.
    assert_eq!(error.boundary_px, 112);
    assert_eq!(error.artifact_px, error.wrong_px() - 112);
}

#[test]
fn a_block_far_from_the_edge_is_artifact() {
    let mut mask = truth().to_grey();
    let width = SIZE as usize;
    for y in 27..30 {
        mask[y * width + 2..y * width + 5].fill(255);
    }
    mask[16 * width + 16] = 127;
    let error = error(&mask);
    assert_eq!((error.false_shadowed, error.false_lit), (9, 1));
    assert_eq!((error.boundary_px, error.artifact_px), (0, 10));
}

#[test]
fn shadow_on_the_background_is_an_artifact() {
    let mut mask = truth().to_grey();
    mask[SIZE as usize + 1] = 128;
    let error = MaskComparison::new(&mask, &truth(), |_, _| true)
        .unwrap()
        .error();
    assert_eq!(
        (error.false_shadowed, error.artifact_px, error.boundary_px),
        (1, 1, 0)
    );
}

#[test]
fn ambiguous_pixels_are_left_out() {
    let mut truth = truth();
    truth.visibility[20 * SIZE as usize + 3] = visibility(Verdict::Ambiguous);
    let error = MaskComparison::new(&[255; 1024], &truth, |_, _| false)
        .unwrap()
        .error();
    assert_eq!((error.ambiguous_px, error.compared_px), (1, 1023));
    assert_eq!(error.false_shadowed, 1023 - 16 * 12);
}

#[test]
fn the_probe_is_asked_of_doubtful_pixels_only() {
    let mut mask = truth().to_grey();
    mask.rotate_right(1);
    mask[29 * SIZE as usize + 3] = 255;
    let asked = AtomicU32::new(0);
    let thin_shadow = |x, y| {
        asked.fetch_add(1, Ordering::Relaxed);
        (x, y) == (3, 29)
    };
    let error = MaskComparison::new(&mask, &truth(), thin_shadow)
        .unwrap()
        .error();
    assert_eq!(asked.into_inner(), 1);
    assert_eq!((error.boundary_px, error.artifact_px), (25, 0));
}

#[test]
fn errors_add_up_and_sizes_must_agree() {
    let one = error(&[255; 1024]);
    let mut sum = one + one;
    sum += MaskError::default();
    assert_eq!(sum.false_shadowed, 2 * one.false_shadowed);
    let wrong = MaskComparison::new(&[0; 3], &truth(), |_, _| false).unwrap_err();
    assert_eq!(
        wrong,
        MaskSizeError {
            mask_px: 3,
            reference_px: 1024
        }
    );
}
