//! A shadow volume of every triangle, in a geometry shader: what silhouettes and tessellation are
//! compared with in Milet et al. 2014, table 4.

use super::parameters::Parameters;
use super::volumes::{
    self, COUNTER_LIMIT, COUNTING_PARAMETER, Counting, DETERMINISM_PARAMETER, NONE_LIMIT,
    REACH_PARAMETER, Reach, STENCIL, StencilVolumes, VolumeParameters, Z_PASS_LIMIT,
};
use super::{MethodError, MethodInfo, PrepareContext, PreparedMethod, ShadowMethod};
use crate::geometry::Determinism;
use crate::gpu::Requirement;
use crate::gpu::native::PrimitiveTopology;
use crate::gpu::shader;
use serde::{Deserialize, Serialize};

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "triangle_gs",
    title: "a shadow volume of every triangle, by a geometry shader",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 3 (after Stich et al. 2007)",
    needs: &[Requirement::GeometryStage, STENCIL],
    limits: &[COUNTER_LIMIT, Z_PASS_LIMIT, NONE_LIMIT],
    parameters: &[DETERMINISM_PARAMETER, COUNTING_PARAMETER, REACH_PARAMETER],
};

/// The method's parameters.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct TriangleGs {
    determinism: Determinism,
    counting: Counting,
    reach: Reach,
}

impl Parameters for TriangleGs {
    fn validate(&self) -> Result<(), String> {
        Ok(())
    }
}

impl ShadowMethod for TriangleGs {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn variant(&self) -> String {
        self.difference()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        let parameters = VolumeParameters {
            determinism: self.determinism,
            reach: self.reach,
        };
        let sides = vec![
            shader::glsl("methods/volumes/position.vert", &[]),
            shader::glsl("methods/triangle_gs/sides.geom", &parameters.defines(&[])),
        ];
        let faces = vec![
            volumes::of_triangles(context, PrimitiveTopology::Triangles, sides),
            volumes::caps(context, parameters),
        ];
        let volumes = StencilVolumes::new(context, self.counting, &[], faces, Vec::new())?;
        Ok(Box::new(volumes))
    }
}
