//! Acne: false-shadowed speckle or stripes on lit surfaces, away from true edges.
//!
//! It is told from a blob by how often a row or column of the picture crosses it: a blob of any size
//! once, a streak or an outline once or twice, speckle and moiré more often. So the measure does not
//! depend on the size of pixels or texels.

use super::clusters::Cluster;
use super::frame::{JudgedFrame, spread};
use crate::metrics::regions::{Sign, artifact_sign};
use crate::reference::Verdict;

/// What a cluster must reach to be speckle.
struct Bar {
    /// It has at least so many pixels, and
    min_px: usize,
    /// is crossed so often, if it has
    crossings: f64,
    /// at least so many regions,
    min_regions: usize,
    /// or else so often.
    crossings_of_few: f64,
}

const BAR: Bar = Bar {
    min_px: 16,
    crossings: 2.0,
    min_regions: 8,
    crossings_of_few: 3.0,
};

/// The bar where texels are known, for then errors along true edges are told apart by them.
const BAR_WITH_TEXELS: Bar = Bar {
    min_px: 8,
    crossings: 1.5,
    min_regions: 3,
    crossings_of_few: 2.0,
};

/// At least this share of the pixels shows a lit surface (the rest is background),
const LIT_SHARE: f64 = 0.9;
/// and this share has no true edge
const AWAY_SHARE: f64 = 0.5;
/// within this many pixels.
const AWAY_PX: f64 = 4.0;

/// Where texels are known, no speckle is asked for this many texels (and the reach of the filter) away
/// from the true edge: there a map has nothing but the surface itself to shadow it with.
const AWAY_TEXELS: f64 = 2.0;

/// At most this many pixels of a cluster are asked for their distance from the edge.
const EDGE_SAMPLES: usize = 1024;

/// Whether a cluster of false-shadowed regions is acne.
pub(super) fn is_speckle(frame: &JudgedFrame<'_>, cluster: &Cluster) -> bool {
    let bar = if frame.texel.is_some() {
        BAR_WITH_TEXELS
    } else {
        BAR
    };
    let away_texels = AWAY_TEXELS + f64::from(frame.texel_reach);
    if let Some(texel_px) = frame.texel_px
        && is_lit_and_away(frame, &cluster.pixels, AWAY_PX.max(away_texels * texel_px))
    {
        return true;
    }
    if cluster.pixels.len() < bar.min_px {
        return false;
    }
    let crossings = crossings(frame, &cluster.pixels);
    let broken = cluster.regions >= bar.min_regions && crossings >= bar.crossings;
    (broken || crossings >= bar.crossings_of_few)
        && is_lit_and_away(frame, &cluster.pixels, AWAY_PX)
}

/// How often a row crosses the pixels, in the mean over the rows that do; or a column, if more often.
fn crossings(frame: &JudgedFrame<'_>, pixels: &[usize]) -> f64 {
    let (width, results) = (frame.width, frame.comparison.results());
    let in_shadow = |pixel: usize| artifact_sign(results[pixel]) == Some(Sign::FalseShadowed);
    let begins = |pixel: usize| {
        let along_row = pixel.is_multiple_of(width) || !in_shadow(pixel - 1);
        let along_column = pixel < width || !in_shadow(pixel - width);
        [along_row, along_column]
    };
    let mut runs = [0usize; 2];
    for &pixel in pixels {
        let [along_row, along_column] = begins(pixel);
        runs[0] += usize::from(along_row);
        runs[1] += usize::from(along_column);
    }
    let distinct = |of: fn(usize, usize) -> usize| {
        let mut lines: Vec<usize> = pixels.iter().map(|&pixel| of(pixel, width)).collect();
        lines.sort_unstable();
        lines.dedup();
        lines.len()
    };
    let rows = distinct(|pixel, width| pixel / width);
    let columns = distinct(|pixel, width| pixel % width);
    (runs[0] as f64 / rows as f64).max(runs[1] as f64 / columns as f64)
}

/// Whether pixels show a lit surface, farther than this from the true edge.
fn is_lit_and_away(frame: &JudgedFrame<'_>, pixels: &[usize], away_px: f64) -> bool {
    let truth = frame.comparison.truth;
    let lit = pixels
        .iter()
        .filter(|&&pixel| truth.verdict(pixel) == Verdict::Lit);
    if (lit.count() as f64) < LIT_SHARE * pixels.len() as f64 {
        return false;
    }
    let edge_px = |&pixel: &usize| frame.edges.of(pixel);
    let samples: Vec<f64> = spread(pixels, EDGE_SAMPLES).map(edge_px).collect();
    let away = samples.iter().filter(|&&px| px > away_px).count();
    away as f64 >= AWAY_SHARE * samples.len() as f64
}
