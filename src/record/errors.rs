//! The rows of `errors.csv`, `regions.csv` and `bias.csv`: what is wrong with masks, where and how.

use crate::variant::Variant;
use serde::{Deserialize, Serialize};

/// A mask held against the reference: a row of `errors.csv`, for each verified frame of each cell.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameError {
    /// Name of the scene.
    pub scene: String,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: Variant,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Number of the frame among the verified ones, from zero.
    pub frame: u32,
    /// Where on the flight the frame lies, in seconds.
    pub time_s: f64,
    /// Lit, but in shadow by the reference.
    pub false_lit: u64,
    /// In shadow, but lit by the reference.
    pub false_shadowed: u64,
    /// Of the wrong pixels, those within one pixel of the true shadow boundary.
    pub boundary_px: u64,
    /// Of the wrong pixels, those farther from it.
    pub artifact_px: u64,
    /// Left out of all the others, because the reference itself cannot decide.
    pub ambiguous_px: u64,
    /// Held against the reference, background included.
    pub compared_px: u64,
    /// Wrong pixels by their distance from the true shadow boundary, as [`pairs_to_text`](super::pairs_to_text) writes them:
    /// `1=30;2=12;4=5;...;more=0`, each name the largest distance in pixels of its class.
    pub distances: String,
    /// Distance of the farthest wrong pixel; empty where nothing is wrong, or the picture has no boundary.
    pub distance_px_max: Option<f64>,
    /// Connected regions of artifact pixels.
    pub regions: u64,
    /// Pixels of the largest of them.
    pub largest_region_px: u64,
    /// Wrong pixels by the kind of error, as [`pairs_to_text`](super::pairs_to_text) writes them: `acne=120;unlabelled=3`.
    pub labels: String,
    /// Surface points that the next frame shows too, whose truth is the same there.
    pub followed_px: Option<u64>,
    /// Of these, the ones that turn from right to wrong or from wrong to right.
    pub flicker_px: Option<u64>,
    /// Mean FLIP of the shaded picture, against one shaded by the reference: 0 alike to 1.
    pub flip: Option<f64>,
}

/// A connected region of artifact pixels: a row of `regions.csv`, for the largest of each frame.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RegionRow {
    /// Name of the scene.
    pub scene: String,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: Variant,
    /// Number of the frame among the verified ones, from zero.
    pub frame: u32,
    /// `false_lit` or `false_shadowed`.
    pub sign: String,
    /// The kind of error; `unlabelled` where the evidence is not clear.
    pub label: String,
    /// Its size in pixels.
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

/// The smallest bias without acne: a row of `bias.csv`, for each cell that asked for it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BiasRow {
    /// Name of the scene.
    pub scene: String,
    /// Id of the method.
    pub method: String,
    /// Variant of the method, `slope_bias=search` in it.
    pub variant: Variant,
    /// Side of the map in texels.
    pub resolution: u32,
    /// The bias that was found, in texels.
    pub slope_bias: f64,
    /// Acne without any slope bias, in pixels a frame.
    pub acne_px_unbiased: f64,
    /// Acne with the bias found, in pixels a frame: what even the largest bias leaves.
    pub acne_px: f64,
    /// Detached shadow without any slope bias, in pixels a frame.
    pub detached_px_unbiased: f64,
    /// Detached shadow with the bias found: what it costs, in pixels a frame.
    pub detached_px: f64,
    /// How many biases were tried.
    pub tried: u32,
}
