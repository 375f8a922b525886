//! A shadow volume of every triangle, in a geometry shader: what silhouettes and tessellation are
//! compared with in Milet et al. 2014, table 4.

use super::clash;
use super::faces;
use super::volume_limits;
use super::volume_parameters::StageVolumeParameters;
use super::volumes::{STENCIL, StencilVolumes};
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod};
use crate::frame::DepthSetup;
use crate::frame::PreparedMethod;
use crate::gpu::Capability;
use crate::gpu::native::PrimitiveTopology;
use crate::gpu::shader;
use crate::parameters;

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "triangle_gs",
    title: "a shadow volume of every triangle, by a geometry shader",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 3 (after Stich et al. 2007)",
    needs: &[Capability::GeometryStage, STENCIL],
    limits: &[
        volume_limits::LIMITS,
        volume_limits::STAGE_LIMITS,
        volume_limits::TRIANGLE_LIMITS,
    ],
    clashes: clash::OF_VOLUMES,
    tolerated_share: 0.0,
};

parameters! {
    /// The method's parameters.
    pub(super) struct TriangleGs {
        ..volume: StageVolumeParameters;
    }
}

impl ShadowMethod for TriangleGs {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn depth_setup(&self) -> DepthSetup {
        self.volume.depth_setup()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let parameters = &self.volume.planned(&context.scene.flight.light)?;
        let context = &parameters.casters(context)?;
        let sides = vec![
            shader::glsl("methods/volumes/position.vert", &[]),
            shader::glsl("methods/triangle_gs/sides.geom", &parameters.defines(&[])),
        ];
        let faces = vec![
            faces::of_triangles(context, PrimitiveTopology::Triangles, sides)?,
            faces::caps(context, parameters),
        ];
        let volumes = StencilVolumes::new(context, parameters, &[], faces, Vec::new())?;
        Ok(Box::new(volumes))
    }
}
