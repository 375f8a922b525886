//! How many pixels of a shadow mask are wrong, in which direction, and how far from the true edge.

use rayon::prelude::*;
use serde::Serialize;
use std::ops::{Add, AddAssign};

use crate::reference::{ReferenceMask, Verdict, Visibility};

/// A mask value from which a pixel counts as in shadow.
pub const SHADOWED_FROM: u8 = 128;

/// Counts of wrong pixels. `false_lit + false_shadowed` is the same as `boundary_px + artifact_px`,
/// and `compared_px + ambiguous_px` is the size of the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct MaskError {
    /// Lit, but in shadow by the reference.
    pub false_lit: u64,
    /// In shadow, but lit by the reference or background.
    pub false_shadowed: u64,
    /// Of the wrong pixels, those within one pixel of the true shadow boundary.
    pub boundary_px: u64,
    /// Of the wrong pixels, those farther from it, and all those at the background.
    pub artifact_px: u64,
    /// Left out, because the reference cannot decide.
    pub ambiguous_px: u64,
    /// Held against the reference, background included.
    pub compared_px: u64,
}

/// The part of a picture that may be ambiguous before the reader should know.
const MAX_AMBIGUOUS: f64 = 0.01;

/// See [`MaskError::undecided`].
#[must_use]
pub fn undecided(ambiguous_px: u64, compared_px: u64) -> Option<String> {
    let share = ambiguous_px as f64 / (ambiguous_px + compared_px).max(1) as f64;
    (share > MAX_AMBIGUOUS).then(|| {
        format!(
            "the truth cannot decide {:.1} % of the picture, and errors there do not count: the light or the eye lies \
             in the plane of a visible surface",
            100.0 * share
        )
    })
}

impl MaskError {
    /// Pixels that are wrong in any way.
    #[must_use]
    pub fn wrong_px(&self) -> u64 {
        self.false_lit + self.false_shadowed
    }

    /// Words on how much of the picture the reference cannot decide, where that is so much that the other counts say
    /// little.
    #[must_use]
    pub fn undecided(&self) -> Option<String> {
        undecided(self.ambiguous_px, self.compared_px)
    }
}

impl Add for MaskError {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            false_lit: self.false_lit + other.false_lit,
            false_shadowed: self.false_shadowed + other.false_shadowed,
            boundary_px: self.boundary_px + other.boundary_px,
            artifact_px: self.artifact_px + other.artifact_px,
            ambiguous_px: self.ambiguous_px + other.ambiguous_px,
            compared_px: self.compared_px + other.compared_px,
        }
    }
}

impl AddAssign for MaskError {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// Where a wrong pixel lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Within one pixel of the true shadow boundary.
    Boundary,
    /// Farther from it, or at the background.
    Artifact,
}

/// What became of one pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PixelResult {
    /// As the reference says.
    Right,
    /// Lit, but in shadow by the reference.
    FalseLit(Place),
    /// In shadow, but lit by the reference or background.
    FalseShadowed(Place),
    /// The reference cannot decide.
    Ambiguous,
}

impl PixelResult {
    /// Where the pixel lies, if it is wrong.
    #[must_use]
    pub fn wrong_place(self) -> Option<Place> {
        match self {
            Self::Right | Self::Ambiguous => None,
            Self::FalseLit(place) | Self::FalseShadowed(place) => Some(place),
        }
    }
}

/// A mask and a reference of different sizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a mask of {mask_px} pixels cannot be held against a reference of {reference_px}")]
pub struct MaskSizeError {
    /// Pixels of the mask.
    pub mask_px: usize,
    /// Pixels of the reference.
    pub reference_px: usize,
}

/// A shadow mask held against the reference, pixel by pixel.
#[derive(Clone, Debug)]
pub struct MaskComparison<'a> {
    pub(super) truth: &'a ReferenceMask,
    results: Vec<PixelResult>,
}

impl<'a> MaskComparison<'a> {
    /// Compares a mask (one byte a pixel, by rows from the top; 128 and above is in shadow).
    ///
    /// `near_boundary` says of column and row whether the true shadow boundary passes within one
    /// pixel of the centre, for which there is
    /// [`BoundaryProbe::near_boundary`](crate::reference::BoundaryProbe::near_boundary). It is
    /// asked only of wrong pixels that no neighbour's verdict shows to be at the boundary: mostly
    /// never, so that a caller may build the probe at the first question.
    ///
    /// # Errors
    /// [`MaskSizeError`] for a mask of another size.
    pub fn new(
        mask: &[u8],
        truth: &'a ReferenceMask,
        near_boundary: impl Fn(u32, u32) -> bool + Sync,
    ) -> Result<Self, MaskSizeError> {
        let (mask_px, reference_px) = (mask.len(), truth.visibility.len());
        if mask_px != reference_px {
            return Err(MaskSizeError {
                mask_px,
                reference_px,
            });
        }
        let place = |pixel: usize| {
            let (x, y) = (pixel as u32 % truth.width, pixel as u32 / truth.width);
            if truth.boundary_among_neighbours(x, y) || near_boundary(x, y) {
                Place::Boundary
            } else {
                Place::Artifact
            }
        };
        let result = |(pixel, (&value, &visibility)): (usize, (&u8, &Option<Visibility>))| match (
            Verdict::of(visibility),
            Self::is_shadowed(value),
        ) {
            (Verdict::Ambiguous, _) => PixelResult::Ambiguous,
            (Verdict::Background, true) => PixelResult::FalseShadowed(Place::Artifact),
            (Verdict::Lit, true) => PixelResult::FalseShadowed(place(pixel)),
            (Verdict::Shadowed, false) => PixelResult::FalseLit(place(pixel)),
            (Verdict::Background | Verdict::Lit, false) | (Verdict::Shadowed, true) => {
                PixelResult::Right
            }
        };
        let pixels = mask
            .par_iter()
            .zip(&truth.visibility)
            .enumerate()
            .with_min_len(64);
        Ok(Self {
            truth,
            results: pixels.map(result).collect(),
        })
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.truth.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.truth.height
    }

    /// Whether the mask has a pixel in shadow; `None` where the reference cannot decide.
    #[must_use]
    pub fn shadowed(&self, pixel: usize) -> Option<bool> {
        match self.results[pixel] {
            PixelResult::Ambiguous => None,
            PixelResult::FalseLit(_) => Some(false),
            PixelResult::FalseShadowed(_) => Some(true),
            PixelResult::Right => Some(self.truth.verdict(pixel) == Verdict::Shadowed),
        }
    }

    /// Whether a value of a mask counts as in shadow.
    #[must_use]
    pub fn is_shadowed(value: u8) -> bool {
        value >= SHADOWED_FROM
    }

    /// What became of each pixel, by rows from the top.
    #[must_use]
    pub fn results(&self) -> &[PixelResult] {
        &self.results
    }

    /// The sum over all pixels.
    #[must_use]
    pub fn error(&self) -> MaskError {
        let mut error = MaskError::default();
        for result in &self.results {
            let place = match result {
                PixelResult::Ambiguous => {
                    error.ambiguous_px += 1;
                    continue;
                }
                PixelResult::Right => None,
                PixelResult::FalseLit(place) => {
                    error.false_lit += 1;
                    Some(place)
                }
                PixelResult::FalseShadowed(place) => {
                    error.false_shadowed += 1;
                    Some(place)
                }
            };
            error.compared_px += 1;
            match place {
                Some(Place::Boundary) => error.boundary_px += 1,
                Some(Place::Artifact) => error.artifact_px += 1,
                None => {}
            }
        }
        error
    }
}

#[cfg(test)]
#[path = "mask_error_tests.rs"]
mod tests;
