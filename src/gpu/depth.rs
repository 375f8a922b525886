//! Which way depth runs.

use serde::{Deserialize, Serialize};

/// What the depth buffer holds at the near plane and at infinity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DepthDirection {
    /// 1 at the near plane, 0 at infinity: floating-point numbers are finest where depth is coarsest.
    #[default]
    Reversed,
    /// 0 at the near plane, 1 at infinity.
    Standard,
}

impl DepthDirection {
    /// Depth at infinity.
    pub fn far(self) -> f32 {
        match self {
            Self::Reversed => 0.0,
            Self::Standard => 1.0,
        }
    }

    /// The depth test that what is nearer than everything so far passes.
    pub fn nearer(self) -> wgpu::CompareFunction {
        match self {
            Self::Reversed => wgpu::CompareFunction::Greater,
            Self::Standard => wgpu::CompareFunction::Less,
        }
    }

    /// The depth test that what is farther than what is there passes.
    pub fn farther(self) -> wgpu::CompareFunction {
        match self {
            Self::Reversed => wgpu::CompareFunction::Less,
            Self::Standard => wgpu::CompareFunction::Greater,
        }
    }
}
