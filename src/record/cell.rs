//! What tells a cell from all others, and what is known of it before it is measured.

use crate::variant::Variant;

/// One point of a run's matrix, measured or not.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Cell {
    /// Name of the scene.
    pub scene: String,
    /// Triangles that cast, where the scene could be loaded.
    pub triangles: Option<u64>,
    /// Objects that cast, where the scene could be loaded.
    pub objects: Option<u64>,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: Variant,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// What the method counted while it was prepared.
    pub counters: Vec<(String, u64)>,
}
