//! The picture of a comparison: what is wrong, coloured over a dimmed reference.

use super::mask_error::{MaskComparison, PixelResult, Place};
use crate::reference::Verdict;

/// False lit, farther than one pixel from the true shadow boundary: full red.
pub const FALSE_LIT_ARTIFACT_RGB: [u8; 3] = [255, 40, 30];
/// False lit, at the true shadow boundary: a muted red.
pub const FALSE_LIT_BOUNDARY_RGB: [u8; 3] = [165, 70, 65];
/// False shadowed, farther than one pixel from the true shadow boundary: full blue.
pub const FALSE_SHADOWED_ARTIFACT_RGB: [u8; 3] = [30, 140, 255];
/// False shadowed, at the true shadow boundary: a muted blue.
pub const FALSE_SHADOWED_BOUNDARY_RGB: [u8; 3] = [65, 100, 160];
/// The reference cannot decide: yellow.
pub const AMBIGUOUS_RGB: [u8; 3] = [235, 205, 40];

/// Greys of pixels that are right, all darker than any colour.
const BACKGROUND_GREY: u8 = 0;
const SHADOWED_GREY: u8 = 24;
const LIT_GREY: u8 = 60;

impl MaskComparison<'_> {
    /// The picture of the comparison: 8-bit RGB, by rows from the top.
    ///
    /// Right pixels show the reference, dimmed. Red and blue stay apart for colour-blind eyes.
    #[must_use]
    pub fn error_map(&self) -> Vec<u8> {
        let colour = |(result, verdict): (&PixelResult, Verdict)| match result {
            PixelResult::FalseLit(Place::Artifact) => FALSE_LIT_ARTIFACT_RGB,
            PixelResult::FalseLit(Place::Boundary) => FALSE_LIT_BOUNDARY_RGB,
            PixelResult::FalseShadowed(Place::Artifact) => FALSE_SHADOWED_ARTIFACT_RGB,
            PixelResult::FalseShadowed(Place::Boundary) => FALSE_SHADOWED_BOUNDARY_RGB,
            PixelResult::Ambiguous => AMBIGUOUS_RGB,
            PixelResult::Right => match verdict {
                Verdict::Lit => [LIT_GREY; 3],
                Verdict::Shadowed => [SHADOWED_GREY; 3],
                Verdict::Background | Verdict::Ambiguous => [BACKGROUND_GREY; 3],
            },
        };
        self.results()
            .iter()
            .zip(self.truth.verdicts())
            .flat_map(colour)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::fixtures::of_verdicts;

    #[test]
    fn each_result_has_its_colour() {
        use Verdict::{Ambiguous, Background, Lit, Shadowed};
        let verdicts = vec![
            Lit, Shadowed, Background, Background, Ambiguous, Lit, Lit, Shadowed,
        ];
        let truth = of_verdicts(4, 2, verdicts);
        let mask = [0, 255, 0, 255, 0, 0, 255, 0];
        let comparison = MaskComparison::new(&mask, &truth, |_, _| false).unwrap();
        let map = comparison.error_map();
        let expected = [
            [LIT_GREY; 3],
            [SHADOWED_GREY; 3],
            [BACKGROUND_GREY; 3],
            FALSE_SHADOWED_ARTIFACT_RGB,
            AMBIGUOUS_RGB,
            [LIT_GREY; 3],
            FALSE_SHADOWED_BOUNDARY_RGB,
            FALSE_LIT_BOUNDARY_RGB,
        ];
        assert_eq!(map, expected.as_flattened());
    }
}
