//! Connected regions of artifact pixels.

use imageproc::image::{GrayImage, Luma};
use imageproc::region_labelling::{Connectivity, connected_components};
use std::cmp::Reverse;

use super::label::Label;
use super::mask_error::{MaskComparison, PixelResult, Place};

/// In which direction a pixel is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sign {
    /// Lit, but in shadow by the reference.
    FalseLit,
    /// In shadow, but lit by the reference or background.
    FalseShadowed,
}

impl Sign {
    /// As it is written in results.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::FalseLit => "false_lit",
            Self::FalseShadowed => "false_shadowed",
        }
    }
}

/// Artifact pixels of one sign that hang together by sides or corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    /// In which direction its pixels are wrong.
    pub sign: Sign,
    /// What kind of error it is.
    pub label: Label,
    /// Number of its pixels.
    pub size_px: u64,
    /// Its leftmost column.
    pub left: u32,
    /// Its topmost row.
    pub top: u32,
    /// Its rightmost column.
    pub right: u32,
    /// Its bottom row.
    pub bottom: u32,
}

/// A region with its pixels, counted by rows from the top, in rising order.
pub(super) struct Artifact {
    pub(super) region: Region,
    pub(super) pixels: Vec<usize>,
}

/// The sign of a pixel that is an artifact.
pub(super) fn artifact_sign(result: PixelResult) -> Option<Sign> {
    match result {
        PixelResult::FalseLit(Place::Artifact) => Some(Sign::FalseLit),
        PixelResult::FalseShadowed(Place::Artifact) => Some(Sign::FalseShadowed),
        _ => None,
    }
}

/// All regions of a comparison, unlabelled, the largest first.
pub(super) fn artifacts(comparison: &MaskComparison<'_>) -> Vec<Artifact> {
    let (width, results) = (comparison.width(), comparison.results());
    let classes: Vec<u8> = results
        .iter()
        .map(|&result| artifact_sign(result).map_or(0, |sign| 1 + sign as u8))
        .collect();
    if classes.iter().all(|&class| class == 0) {
        return Vec::new();
    }
    // Pixels of different value never hang together.
    let Some(classes) = GrayImage::from_raw(width, comparison.height(), classes) else {
        return Vec::new();
    };
    let components = connected_components(&classes, Connectivity::Eight, Luma([0]));
    let mut regions: Vec<Artifact> = Vec::new();
    for (pixel, &component) in components.iter().enumerate() {
        let Some(sign) = artifact_sign(results[pixel]) else {
            continue;
        };
        let (x, y) = (pixel as u32 % width, pixel as u32 / width);
        // Components are numbered from one as a scan meets them, so at most one is new.
        if component as usize > regions.len() {
            let region = Region {
                sign,
                label: Label::Unlabelled,
                size_px: 0,
                left: x,
                top: y,
                right: x,
                bottom: y,
            };
            let pixels = Vec::new();
            regions.push(Artifact { region, pixels });
        }
        let Artifact { region, pixels } = &mut regions[component as usize - 1];
        pixels.push(pixel);
        region.size_px += 1;
        region.left = region.left.min(x);
        region.right = region.right.max(x);
        region.bottom = y;
    }
    regions.sort_by_key(|artifact| Reverse(artifact.region.size_px));
    regions
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::fixtures::{of_verdicts, visibility};
    use crate::reference::{ReferenceMask, Verdict};

    fn truth() -> ReferenceMask {
        let verdict = |pixel: usize| match pixel % 40 {
            0..20 => Verdict::Lit,
            _ => Verdict::Shadowed,
        };
        of_verdicts(40, 20, (0..800).map(verdict).collect())
    }

    #[test]
    fn corners_connect_and_signs_part() {
        let truth = truth();
        let mut mask = truth.to_grey();
        for (x, y) in [(2, 4), (3, 5), (4, 4), (10, 10)] {
            mask[y * 40 + x] = 255;
        }
        mask[2 * 40 + 30..2 * 40 + 35].fill(0);
        mask[3 * 40 + 31] = 0;
        // At the boundary: part of no region.
        mask[15 * 40 + 18..15 * 40 + 22].fill(255);
        mask[15 * 40 + 18] = 0;
        let comparison = MaskComparison::new(&mask, &truth, |_, _| false).unwrap();
        let found: Vec<Region> = artifacts(&comparison).iter().map(|a| a.region).collect();
        let region = |sign, size_px, [left, top, right, bottom]: [u32; 4]| Region {
            sign,
            label: Label::Unlabelled,
            size_px,
            left,
            top,
            right,
            bottom,
        };
        let expected = [
            region(Sign::FalseLit, 6, [30, 2, 34, 3]),
            region(Sign::FalseShadowed, 3, [2, 4, 4, 5]),
            region(Sign::FalseShadowed, 1, [10, 10, 10, 10]),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn touching_regions_of_both_signs_stay_apart() {
        let mut truth = truth();
        truth.visibility.fill(visibility(Verdict::Shadowed));
        truth.visibility[..400].fill(visibility(Verdict::Background));
        let mask = [[255; 400], [0; 400]].concat();
        let comparison = MaskComparison::new(&mask, &truth, |_, _| false).unwrap();
        let signs: Vec<_> = artifacts(&comparison)
            .iter()
            .map(|a| (a.region.sign.word(), a.pixels.len()))
            .collect();
        assert_eq!(signs, [("false_shadowed", 400), ("false_lit", 400)]);
    }
}
