//! The rows of `regions.csv` and `bias.csv`.

use crate::variant::Variant;
use serde::{Deserialize, Serialize};

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
