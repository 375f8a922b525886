//! A shadow volume of every triangle, in tessellation shaders (Milet et al. 2014, section 2.1).

use super::clash;
use super::faces::{self, Faces, Fragments};
use super::volume_limits;
use super::volume_parameters::{Counting, FrontCap, StageVolumeParameters};
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
    id: "triangle_ts",
    title: "a shadow volume of every triangle, by tessellation shaders",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 2.1",
    needs: &[Capability::TessellationStage, STENCIL],
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
    pub(super) struct TriangleTs {
        passes: u32 = 2, in 1..=2,
            "2: sides and back cap, then front cap (algorithm 1); 1: a quad twisted into the whole volume (figure 3)";
        ..volume: StageVolumeParameters;
    }
}

impl ShadowMethod for TriangleTs {
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
        let faces = match self.passes {
            1 => vec![single(context, parameters)?],
            _ => vec![
                part(context, parameters, 3)?,
                Faces {
                    z_fail: parameters.front_cap_raster(),
                    in_z_pass: false,
                    ..part(context, parameters, 1)?
                },
            ],
        };
        let volumes = StencilVolumes::new(context, parameters, &[], faces, Vec::new())?;
        Ok(Box::new(volumes))
    }
}

const TRIANGLE_PATCH: PrimitiveTopology = PrimitiveTopology::Patches(3);

/// Sides and back cap at inner level 3, the front cap at 1.
fn part(
    context: &PrepareContext<'_>,
    parameters: &StageVolumeParameters,
    inner_level: u32,
) -> Result<Faces, MethodError> {
    let defines = parameters.defines(&[("INNER_LEVEL", inner_level)]);
    let stages = vec![
        shader::glsl("methods/volumes/position.vert", &[]),
        shader::glsl("methods/triangle_ts/volume.tesc", &defines),
        shader::glsl("methods/triangle_ts/volume.tese", &defines),
    ];
    faces::of_triangles(context, TRIANGLE_PATCH, stages)
}

/// The whole volume in one.
fn single(
    context: &PrepareContext<'_>,
    parameters: &StageVolumeParameters,
) -> Result<Faces, MethodError> {
    // In z-pass, which has no caps, that cap must not count.
    let is_pushed = parameters.front_cap == FrontCap::Far || parameters.counting == Counting::ZPass;
    let push: &[_] = if is_pushed {
        &[("PUSH_FRONT_CAP", 1)]
    } else {
        &[]
    };
    let defines = parameters.defines(push);
    let stages = vec![
        shader::glsl("methods/volumes/position.vert", &[]),
        shader::glsl("methods/triangle_ts/single.tesc", &defines),
        shader::glsl("methods/triangle_ts/single.tese", &defines),
    ];
    Ok(Faces {
        fragments: if is_pushed {
            Fragments::PushFrontCap
        } else {
            Fragments::Count
        },
        ..faces::of_triangles(context, TRIANGLE_PATCH, stages)?
    })
}
