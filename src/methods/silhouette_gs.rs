//! Silhouette shadow volumes in a geometry shader (Milet et al. 2014, the comparison of tables 1
//! and 2): the same decision as in tessellation shaders, one edge a primitive.

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
    id: "silhouette_gs",
    title: "silhouette shadow volumes, side quads by a geometry shader",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 3",
    needs: &[Capability::GeometryStage, STENCIL],
    limits: &[volume_limits::LIMITS, volume_limits::STAGE_LIMITS],
    clashes: clash::OF_VOLUMES,
    tolerated_share: 0.0,
};

/// Side quads by a geometry shader.
#[derive(Debug, Clone)]
pub(super) struct GeometryStage;

/// The method with its parameters.
pub(super) type SilhouetteGs = Silhouette<GeometryStage>;

impl SideStage for GeometryStage {
    fn info() -> &'static MethodInfo {
        &INFO
    }

    /// Every device lets a geometry shader emit 256 vertices: 64 quads.
    const MAX_QUADS: u32 = 64;
    /// Six vertices are the most that any primitive has.
    const MAX_PATCH_OPPOSITES: u32 = 4;
    const NUMBER: PrimitiveTopology = PrimitiveTopology::Points;

    fn patch(opposites: u32) -> (PrimitiveTopology, u32) {
        if opposites <= 2 {
            (PrimitiveTopology::LinesWithAdjacency, 2)
        } else {
            (PrimitiveTopology::TrianglesWithAdjacency, 4)
        }
    }

    fn shaders(defines: &[(&str, u32)]) -> Vec<Spirv> {
        vec![shader::glsl("methods/silhouette_gs/sides.geom", defines)]
    }
}
