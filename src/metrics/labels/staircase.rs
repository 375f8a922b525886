//! Staircases: errors along the true edge that follow the texels of a shadow map.
//!
//! A map gives one answer for all of a texel (seen on one surface), so a texel that the true edge
//! runs through is wrong in part, and the mask changes only from texel to texel. Both are looked for:
//! the first in each region, the second in the whole picture, since it takes many steps to tell a
//! rule from chance.

use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashSet;

use super::frame::{JudgedFrame, TexelLookup};
use crate::metrics::mask_error::Place;
use crate::metrics::regions::Artifact;
use crate::reference::Verdict;

type Texel = [i64; 3];

/// Steps of the mask inside a texel are at most this share of what chance would give.
const MAX_MISSES_TO_CHANCE: f64 = 0.25;

/// Fewer such steps expected by chance are no evidence: texels are about as small as pixels, or the
/// errors are few.
const MIN_EXPECTED_MISSES: f64 = 8.0;

/// At least this share of a region lies in texels that the true edge runs through.
const EDGE_TEXELS_SHARE: f64 = 0.8;

/// A region whose steps ignore texels is no part of the staircase: more of them are inside a texel
/// than this share of what chance would give.
const REGION_MAX_MISSES_TO_CHANCE: f64 = 0.5;

/// Evidence that the errors of a picture follow texels.
pub(super) struct Staircase {
    /// By pixel; looked up at wrong pixels, their neighbours, and along the true edge.
    texels: Vec<Option<Texel>>,
    /// Those that the true edge runs through.
    at_edge: HashSet<Texel>,
    /// How often texels change between neighbouring pixels where errors are.
    chance: f64,
}

/// Neighbouring pixels of one triangle, counted.
#[derive(Default)]
struct Steps {
    pairs: u64,
    texel_changes: u64,
    mask_changes: u64,
    /// Changes of the mask inside a texel.
    misses: u64,
}

impl Staircase {
    /// `None` without texels, or without evidence.
    pub(super) fn find(frame: &JudgedFrame<'_>) -> Option<Self> {
        let texels = look_up(frame, frame.texel?);
        let at_edge = edge_texels(frame, &texels);
        let mut staircase = Self {
            texels,
            at_edge,
            chance: 0.0,
        };
        let results = frame.comparison.results();
        let pixels = (0..results.len())
            .filter(|&pixel| results[pixel].wrong_place().is_some() && staircase.is_at_edge(pixel));
        let steps = staircase.steps(frame, pixels);
        let chance = steps.texel_changes as f64 / steps.pairs.max(1) as f64;
        let expected_misses = steps.mask_changes as f64 * (1.0 - chance);
        staircase.chance = chance;
        let evident = expected_misses >= MIN_EXPECTED_MISSES
            && steps.misses as f64 <= MAX_MISSES_TO_CHANCE * expected_misses;
        evident.then_some(staircase)
    }

    /// Whether a wrong pixel at the boundary is part of the staircase: the map covers it.
    pub(super) fn covers(&self, pixel: usize) -> bool {
        self.texels[pixel].is_some()
    }

    /// Whether a region is part of the staircase.
    pub(super) fn holds(&self, frame: &JudgedFrame<'_>, artifact: &Artifact) -> bool {
        let pixels = &artifact.pixels;
        let at_edge = pixels.iter().filter(|&&pixel| self.is_at_edge(pixel));
        if (at_edge.count() as f64) < EDGE_TEXELS_SHARE * pixels.len() as f64 {
            return false;
        }
        let steps = self.steps(frame, pixels.iter().copied());
        let expected_misses = steps.mask_changes as f64 * (1.0 - self.chance);
        // One step more, lest a single pixel be judged by its few neighbours.
        steps.misses as f64 <= 1.0 + REGION_MAX_MISSES_TO_CHANCE * expected_misses
    }

    fn is_at_edge(&self, pixel: usize) -> bool {
        self.texels[pixel].is_some_and(|texel| self.at_edge.contains(&texel))
    }

    /// Counts the pairs of these pixels with each of their four neighbours.
    fn steps(&self, frame: &JudgedFrame<'_>, pixels: impl Iterator<Item = usize>) -> Steps {
        let mut steps = Steps::default();
        for pixel in pixels {
            for other in neighbours(frame, pixel) {
                let texels = self.texels[pixel].zip(self.texels[other]);
                let comparison = frame.comparison;
                let shadowed = comparison.shadowed(pixel).zip(comparison.shadowed(other));
                let (Some((texel, other_texel)), Some((one, another))) = (texels, shadowed) else {
                    continue;
                };
                let texel_changes = texel != other_texel;
                steps.pairs += 1;
                steps.texel_changes += u64::from(texel_changes);
                steps.mask_changes += u64::from(one != another);
                steps.misses += u64::from(one != another && !texel_changes);
            }
        }
        steps
    }
}

/// The neighbours of a pixel along rows and columns that show the same triangle.
fn neighbours(frame: &JudgedFrame<'_>, pixel: usize) -> impl Iterator<Item = usize> {
    let (width, len) = (frame.width, frame.comparison.results().len());
    let column = pixel % width;
    let own = frame.probe.triangle_id(pixel);
    [
        (column > 0).then(|| pixel - 1),
        (column + 1 < width).then_some(pixel + 1),
        pixel.checked_sub(width),
        Some(pixel + width).filter(|&below| below < len),
    ]
    .into_iter()
    .flatten()
    .filter(move |&other| own != 0 && frame.probe.triangle_id(other) == own)
}

/// Whether the true edge passes between two pixels.
fn edge_between(frame: &JudgedFrame<'_>, one: usize, other: usize) -> bool {
    let truth = frame.comparison.truth;
    matches!(
        (truth.verdict(one), truth.verdict(other)),
        (Verdict::Lit, Verdict::Shadowed) | (Verdict::Shadowed, Verdict::Lit)
    )
}

fn look_up(frame: &JudgedFrame<'_>, texel: &TexelLookup<'_>) -> Vec<Option<Texel>> {
    let results = frame.comparison.results();
    let asked = |pixel: usize| {
        results[pixel].wrong_place().is_some()
            || neighbours(frame, pixel).any(|other| {
                results[other].wrong_place().is_some() || edge_between(frame, pixel, other)
            })
    };
    let at = |pixel: usize| -> Option<Texel> {
        let point: DVec3 = asked(pixel).then(|| frame.probe.point(pixel))??;
        texel(point)
    };
    let pixels = (0..results.len()).into_par_iter().with_min_len(1024);
    pixels.map(at).collect()
}

/// The texels that the true edge runs through, or within a pixel of.
fn edge_texels(frame: &JudgedFrame<'_>, texels: &[Option<Texel>]) -> HashSet<Texel> {
    let results = frame.comparison.results();
    let at_edge = |&(pixel, _): &(usize, &Option<Texel>)| {
        results[pixel].wrong_place() == Some(Place::Boundary)
            || neighbours(frame, pixel).any(|other| edge_between(frame, pixel, other))
    };
    let texels = texels.iter().enumerate();
    texels
        .filter(|(_, texel)| texel.is_some())
        .filter(at_edge)
        .filter_map(|(_, texel)| *texel)
        .collect()
}
