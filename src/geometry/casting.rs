//! Which triangles cast shadows.

use serde::{Deserialize, Serialize};

/// Which triangles cast.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Casting {
    /// Those that face the light, of objects that are closed and have eye and light outside; else all.
    LightFacing,
    /// Of other objects too, where that draws less: first those that face the light, then the rest by their open edges
    /// (see [`super::open_edges`]).
    EachSide,
    /// All.
    All,
}
