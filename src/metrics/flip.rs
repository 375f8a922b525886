//! How different two pictures look to a person.

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};

/// Pictures that are not of the size given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("pictures of {reference_bytes} and {picture_bytes} bytes given, {expected_bytes} expected")]
pub struct PictureSizeError {
    /// Width times height times four.
    pub expected_bytes: usize,
    /// Bytes of the reference.
    pub reference_bytes: usize,
    /// Bytes of the other picture.
    pub picture_bytes: usize,
}

/// The mean over all pixels of FLIP (Andersson et al. 2020, *FLIP: A Difference Evaluator for
/// Alternating Images*): from 0, alike, to 1.
///
/// Pictures are `[width, height]` pixels of 8-bit sRGB and alpha, by rows from the top; alpha is not
/// looked at. The viewer is the one that FLIP assumes by default, with 67 pixels to a degree: a
/// 24-inch 4K display at arm's length.
///
/// Some 0.4 s for 1024 × 768 pixels on one core; nothing where pictures are the same.
///
/// # Errors
/// [`PictureSizeError`] for a picture of another size.
pub fn mean_flip(
    [width, height]: [u32; 2],
    reference_rgba: &[u8],
    picture_rgba: &[u8],
) -> Result<f64, PictureSizeError> {
    let expected_bytes = width as usize * height as usize * 4;
    if reference_rgba.len() != expected_bytes || picture_rgba.len() != expected_bytes {
        return Err(PictureSizeError {
            expected_bytes,
            reference_bytes: reference_rgba.len(),
            picture_bytes: picture_rgba.len(),
        });
    }
    let image = |rgba: &[u8]| {
        let (pixels, _) = rgba.as_chunks::<4>();
        let rgb: Vec<u8> = pixels
            .iter()
            .flat_map(|[r, g, b, _]| [*r, *g, *b])
            .collect();
        FlipImageRgb8::with_data(width, height, &rgb)
    };
    // Also spares the time where a method is exact.
    if reference_rgba == picture_rgba {
        return Ok(0.0);
    }
    let errors = nv_flip::flip(
        image(reference_rgba),
        image(picture_rgba),
        DEFAULT_PIXELS_PER_DEGREE,
    )
    .to_vec();
    Ok(errors.iter().map(|&error| f64::from(error)).sum::<f64>() / errors.len() as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [64, 48];

    fn picture(rgba: [u8; 4]) -> Vec<u8> {
        rgba.repeat(64 * 48)
    }

    #[test]
    fn alike_is_zero_and_black_on_white_is_one() {
        let (black, white) = (picture([0, 0, 0, 255]), picture([255; 4]));
        assert_eq!(mean_flip(SIZE, &white, &white), Ok(0.0));
        let most = mean_flip(SIZE, &white, &black).unwrap();
        assert!(most > 0.95 && most <= 1.0, "{most}");
    }

    #[test]
    fn alpha_is_not_seen() {
        let found = mean_flip(SIZE, &picture([9, 9, 9, 255]), &picture([9, 9, 9, 0])).unwrap();
        assert!(found < 1e-6, "{found}");
    }

    #[test]
    fn more_wrong_pixels_are_more_different() {
        let reference = picture([200, 190, 180, 255]);
        let with_block = |side: usize| {
            let mut picture = reference.clone();
            for row in 10..10 + side {
                picture[(row * 64 + 10) * 4..(row * 64 + 10 + side) * 4].fill(40);
            }
            mean_flip(SIZE, &reference, &picture).unwrap()
        };
        let (small, large) = (with_block(3), with_block(20));
        assert!(
            0.0 < small && 4.0 * small < large && large < 0.6,
            "{small}, {large}"
        );
    }

    #[test]
    fn sizes_must_agree() {
        let error = mean_flip(SIZE, &picture([0; 4]), &[0; 8]).unwrap_err();
        assert_eq!(
            (error.expected_bytes, error.picture_bytes),
            (64 * 48 * 4, 8)
        );
    }
}
