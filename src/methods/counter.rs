//! Where volumes are counted.

use super::{MethodError, PrepareContext};
use crate::frame::{BlendedCounts, DepthSetup, Frame, RESOLVE_STAGE, StencilResolve};
use crate::gpu::{Capability, Stage};
use serde::{Deserialize, Serialize};

/// Where volumes are counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Counter {
    /// In the stencil buffer, whose eight bits are 0 again at 256.
    #[default]
    Stencil8,
    /// In a picture of 16-bit floats, by blending: exact up to 2048.
    Blend16,
    /// In one of 32-bit floats: exact up to 2²⁴.
    Blend32,
}

impl Counter {
    /// Whether a face may count more than once: the stencil adds one or takes it away.
    pub(super) fn takes_weights(self) -> bool {
        self != Self::Stencil8
    }
}

/// Name of the stage that goes on to count what does not face the light, by open edges.
pub(super) const OPEN_EDGES_STAGE: &str = "open_edges";

/// Name of the stage that adds to the mask what that has counted.
pub(super) const RESOLVE_REST_STAGE: &str = "resolve_rest";

/// Counts of a frame, and how they come to the mask.
pub(super) enum Counts {
    Stencil(StencilResolve),
    Blended(Box<BlendedCounts>),
}

impl Counts {
    pub(super) fn new(
        context: &PrepareContext<'_>,
        counter: Counter,
        depth: DepthSetup,
    ) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = context;
        let bits = match counter {
            Counter::Stencil8 => return Ok(Self::Stencil(StencilResolve::new(gpu, depth))),
            Counter::Blend16 => 16,
            Counter::Blend32 => {
                let unable =
                    |reason| MethodError::Unavailable(format!("counter=blend32: {reason}"));
                gpu.check(Capability::FloatBlending).map_err(unable)?;
                32
            }
        };
        let counts = BlendedCounts::new(gpu, resources, bits)?;
        Ok(Self::Blended(Box::new(counts)))
    }

    /// What native passes add to, where their fragment shaders count.
    pub(super) fn texture(&self) -> Option<&wgpu::Texture> {
        match self {
            Self::Stencil(_) => None,
            Self::Blended(counts) => Some(counts.texture()),
        }
    }

    /// What pipelines of wgpu add to.
    pub(super) fn target(&self) -> Option<wgpu::ColorTargetState> {
        match self {
            Self::Stencil(_) => None,
            Self::Blended(counts) => Some(counts.target()),
        }
    }

    /// The same in a pass.
    pub(super) fn attachment(&self) -> Option<wgpu::RenderPassColorAttachment<'_>> {
        match self {
            Self::Stencil(_) => None,
            Self::Blended(counts) => Some(counts.attachment()),
        }
    }

    /// Begins a frame. The G-buffer stage has cleared the stencil buffer.
    pub(super) fn begin(&self, stage: &mut Stage<'_, '_>) {
        if let Self::Blended(counts) = self {
            counts.clear(stage.encoder());
        }
    }

    /// Records the stages that add to the mask what has a count, where counting began with the first of `near_counts` instead of
    /// 0; and with a second one what has a count after `open_edges` are counted as well, as if counting had begun with that.
    pub(super) fn resolve<'f>(
        &self,
        frame: &mut Frame<'f>,
        near_counts: (i32, Option<i32>),
        open_edges: impl FnOnce(&mut Stage<'_, 'f>),
    ) -> anyhow::Result<()> {
        self.add_to_mask(frame, RESOLVE_STAGE, near_counts.0)?;
        if let Some(near_count) = near_counts.1 {
            frame.stage(OPEN_EDGES_STAGE, open_edges);
            self.add_to_mask(frame, RESOLVE_REST_STAGE, near_count)?;
        }
        Ok(())
    }

    fn add_to_mask(
        &self,
        frame: &mut Frame<'_>,
        stage: &'static str,
        begun_with: i32,
    ) -> anyhow::Result<()> {
        match self {
            Self::Stencil(resolve) => {
                resolve.record(frame, stage, begun_with);
                Ok(())
            }
            Self::Blended(counts) => counts.record(frame, stage, begun_with),
        }
    }
}
