//! Silhouette shadow volumes in tessellation shaders (Milet et al. 2014, algorithms 2 to 5).

use super::MethodInfo;
use super::clash;
use super::silhouette::{SideStage, Silhouette};
use super::volume_limits;
use super::volumes::STENCIL;
use crate::gpu::Capability;
use crate::gpu::native::PrimitiveTopology;
use crate::gpu::shader::{self, Spirv};

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "silhouette_ts",
    title: "silhouette shadow volumes, side quads by tessellation shaders",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 2.2",
    needs: &[
        Capability::TessellationStage,
        Capability::GeometryStage,
        STENCIL,
    ],
    limits: &[volume_limits::LIMITS, volume_limits::STAGE_LIMITS],
    clashes: clash::OF_VOLUMES,
    tolerated_share: 0.0,
};

/// Side quads by tessellation shaders.
#[derive(Debug, Clone)]
pub(super) struct TessellationStage;

/// The method with its parameters.
pub(super) type SilhouetteTs = Silhouette<TessellationStage>;

impl SideStage for TessellationStage {
    fn info() -> &'static MethodInfo {
        &INFO
    }

    /// 2 · 32 − 1 is the largest odd tessellation level that every device has.
    const MAX_QUADS: u32 = 32;
    /// Every device has patches of 32 vertices.
    const MAX_PATCH_OPPOSITES: u32 = 30;
    const NUMBER: PrimitiveTopology = PrimitiveTopology::Patches(1);

    fn patch(opposites: u32) -> (PrimitiveTopology, u32) {
        (PrimitiveTopology::Patches(2 + opposites), opposites)
    }

    fn shaders(defines: &[(&str, u32)]) -> Vec<Spirv> {
        vec![
            shader::glsl("methods/silhouette_ts/sides.tesc", defines),
            shader::glsl("methods/silhouette_ts/sides.tese", defines),
        ]
    }
}
