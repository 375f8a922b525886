//! Where volumes are counted.

use super::{MethodError, PrepareContext};
use crate::frame::{BlendedCounts, DepthSetup, Frame, RESOLVE_STAGE, StencilResolve, Targets};
use crate::gpu::native::CountIn;
use crate::gpu::{Capability, Stage};
use serde::{Deserialize, Serialize};

/// Name of the stage that draws the volumes and counts them.
const VOLUMES_STAGE: &str = "volumes";

/// Where volumes are counted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Counter {
    /// In the stencil buffer, whose eight bits are 0 again at 256.
    #[default]
    Stencil8,
    /// There, by values that fragment shaders read and write, in two rounds: one up to 256, one up to 255. No count below
    /// their product, 65,280, is 0 in both.
    StencilExport,
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

/// Where volumes are counted that wgpu's pipelines draw.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum PortableCounter {
    /// [`Counter::Stencil8`].
    #[default]
    Stencil8,
    /// [`Counter::Blend16`].
    Blend16,
    /// [`Counter::Blend32`].
    Blend32,
}

impl From<PortableCounter> for Counter {
    fn from(counter: PortableCounter) -> Self {
        match counter {
            PortableCounter::Stencil8 => Self::Stencil8,
            PortableCounter::Blend16 => Self::Blend16,
            PortableCounter::Blend32 => Self::Blend32,
        }
    }
}

/// A round over all volumes: its stages, and what it counts to.
pub(super) struct Round {
    /// Draws the volumes.
    pub volumes: &'static str,
    /// Adds to the mask what has a count.
    resolve: &'static str,
    /// Goes on to count what does not face the light, by open edges.
    open_edges: &'static str,
    /// Adds to the mask what that has counted.
    resolve_rest: &'static str,
    /// In the stencil, so many are 0 again.
    pub modulus: u32,
}

/// The first round, mostly the only one.
pub(super) const ROUND: Round = Round {
    volumes: VOLUMES_STAGE,
    resolve: RESOLVE_STAGE,
    open_edges: "open_edges",
    resolve_rest: "resolve_rest",
    modulus: 256,
};

/// The second one of [`Counter::StencilExport`].
const SECOND_ROUND: Round = Round {
    volumes: "volumes_again",
    resolve: "resolve_again",
    open_edges: "open_edges_again",
    resolve_rest: "resolve_rest_again",
    modulus: 255,
};

/// Counts of a frame, and how they come to the mask.
pub(super) enum Counts {
    Stencil(StencilResolve),
    StencilInShaders(StencilResolve),
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
            Counter::StencilExport => {
                let is_readable = resources.depth.stencil_in_shaders;
                assert!(is_readable, "the frame has another method's depth buffer");
                return Ok(Self::StencilInShaders(StencilResolve::new(gpu, depth)));
            }
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

    /// Where native passes count.
    pub(super) fn count_in(&self) -> CountIn {
        match self {
            Self::Stencil(_) => CountIn::Stencil,
            Self::StencilInShaders(_) => CountIn::StencilInShaders,
            Self::Blended(counts) => CountIn::Blended(counts.texture().clone()),
        }
    }

    /// How often all volumes are counted.
    pub(super) fn rounds(&self) -> &'static [Round] {
        match self {
            Self::Stencil(_) | Self::Blended(_) => &[ROUND],
            Self::StencilInShaders(_) => &[ROUND, SECOND_ROUND],
        }
    }

    /// What pipelines of wgpu add to.
    pub(super) fn target(&self) -> Option<wgpu::ColorTargetState> {
        match self {
            Self::Stencil(_) | Self::StencilInShaders(_) => None,
            Self::Blended(counts) => Some(counts.target()),
        }
    }

    /// The same in a pass.
    pub(super) fn attachment(&self) -> Option<wgpu::RenderPassColorAttachment<'_>> {
        match self {
            Self::Stencil(_) | Self::StencilInShaders(_) => None,
            Self::Blended(counts) => Some(counts.attachment()),
        }
    }

    /// Begins a round. The G-buffer stage has cleared the stencil buffer for the first.
    pub(super) fn begin(&self, stage: &mut Stage<'_, '_>, targets: &Targets, round: &Round) {
        match self {
            Self::Blended(counts) => counts.clear(stage.encoder()),
            Self::Stencil(_) | Self::StencilInShaders(_) if round.modulus == ROUND.modulus => {}
            Self::Stencil(resolve) | Self::StencilInShaders(resolve) => {
                resolve.clear(stage.encoder(), targets);
            }
        }
    }

    /// Records the stages of a round that add to the mask what has a count, where counting began with the first of `near_counts` instead of
    /// 0; and with a second one what has a count after `open_edges` are counted as well, as if counting had begun with that.
    pub(super) fn resolve<'f>(
        &self,
        frame: &mut Frame<'f>,
        round: &Round,
        near_counts: (i32, Option<i32>),
        open_edges: impl FnOnce(&mut Stage<'_, 'f>),
    ) -> anyhow::Result<()> {
        self.add_to_mask(frame, round.resolve, near_counts.0, round.modulus)?;
        if let Some(near_count) = near_counts.1 {
            frame.stage(round.open_edges, open_edges);
            self.add_to_mask(frame, round.resolve_rest, near_count, round.modulus)?;
        }
        Ok(())
    }

    fn add_to_mask(
        &self,
        frame: &mut Frame<'_>,
        stage: &'static str,
        begun_with: i32,
        modulus: u32,
    ) -> anyhow::Result<()> {
        match self {
            Self::Stencil(resolve) | Self::StencilInShaders(resolve) => {
                resolve.record(frame, stage, begun_with, modulus);
                Ok(())
            }
            Self::Blended(counts) => counts.record(frame, stage, begun_with),
        }
    }
}
