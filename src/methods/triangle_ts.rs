//! A shadow volume of every triangle, in tessellation shaders (Milet et al. 2014, section 2.1).

use super::parameters::{Parameters, in_range};
use super::volumes::{
    self, COUNTER_LIMIT, COUNTING_PARAMETER, Counting, DETERMINISM_PARAMETER, Faces, NONE_LIMIT,
    REACH_PARAMETER, Reach, STENCIL, StencilVolumes, VolumeParameters, Z_PASS_LIMIT,
};
use super::{MethodError, MethodInfo, PrepareContext, PreparedMethod, ShadowMethod};
use crate::geometry::Determinism;
use crate::gpu::Requirement;
use crate::gpu::native::{PrimitiveTopology, Raster};
use crate::gpu::shader;
use serde::{Deserialize, Serialize};

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "triangle_ts",
    title: "a shadow volume of every triangle, by tessellation shaders",
    source: "Milet, Kobrtek, Zemčík, Pečiva 2014, section 2.1",
    needs: &[Requirement::TessellationStage, STENCIL],
    limits: &[
        COUNTER_LIMIT,
        Z_PASS_LIMIT,
        NONE_LIMIT,
        "front_cap=in_place: acne, where a cap and its own surface get depths that differ in the \
         last bit; push_back_px takes most of it away",
        "single wrong pixels at edges between lit triangles, in about one frame of ten",
    ],
    parameters: &[
        (
            "passes",
            "2",
            "2: sides and back cap, then front cap (algorithm 1); 1: a quad twisted into the whole \
             volume (figure 3)",
        ),
        (
            "front_cap",
            "far",
            "where the front cap of passes=1 is: far (pushed to the far plane by a fragment shader, \
             as in the paper), in_place",
        ),
        (
            "push_back_px",
            "1/256",
            "sides are pushed away by the change of their depth over so many pixels, 0 to 1; 0: as in \
             the paper, with some more wrong pixels at edges",
        ),
        DETERMINISM_PARAMETER,
        COUNTING_PARAMETER,
        REACH_PARAMETER,
    ],
};

/// Neighbouring triangles share a side quad, in opposite windings. Its two copies should cancel to the
/// pixel, but the tessellator cuts them along different diagonals and orders their vertices differently, and
/// they differ in the last bits of depth.
/// That decides pixels close to their near edge, on the surface that they start from, which they are never
/// in front of: pushed back by a step of the rasteriser's grid, 1/256 pixel, both are mostly behind it.
const PUSH_BACK_PX: f32 = 1.0 / 256.0;

/// Where the front cap is that is drawn with the rest of the volume.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum FrontCap {
    /// On the far plane.
    #[default]
    Far,
    /// On the triangle.
    InPlace,
}

/// The method's parameters.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct TriangleTs {
    passes: u32,
    front_cap: FrontCap,
    push_back_px: f32,
    determinism: Determinism,
    counting: Counting,
    reach: Reach,
}

impl Default for TriangleTs {
    fn default() -> Self {
        Self {
            passes: 2,
            front_cap: FrontCap::default(),
            push_back_px: PUSH_BACK_PX,
            determinism: Determinism::default(),
            counting: Counting::default(),
            reach: Reach::default(),
        }
    }
}

impl Parameters for TriangleTs {
    fn validate(&self) -> Result<(), String> {
        in_range("passes", self.passes, 1..=2)?;
        in_range("push_back_px", self.push_back_px, 0.0..=1.0)?;
        if self.passes == 2 && self.front_cap == FrontCap::InPlace {
            return Err(
                "`front_cap = \"in_place\"` needs `passes = 1`: the second pass counts the \
                        front cap without a depth test"
                    .to_owned(),
            );
        }
        Ok(())
    }
}

impl ShadowMethod for TriangleTs {
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
        let pushed_back = |faces| Faces {
            push_back_px: self.push_back_px,
            ..faces
        };
        let faces = match self.passes {
            1 => vec![pushed_back(single(context, parameters, self.front_cap))],
            _ => vec![
                pushed_back(part(context, parameters, 3)),
                Faces {
                    z_fail: Raster::CountAll,
                    in_z_pass: false,
                    ..part(context, parameters, 1)
                },
            ],
        };
        let volumes = StencilVolumes::new(context, self.counting, &[], faces, Vec::new())?;
        Ok(Box::new(volumes))
    }
}

const TRIANGLE_PATCH: PrimitiveTopology = PrimitiveTopology::Patches(3);

/// Sides and back cap at inner level 3, the front cap at 1.
fn part(context: &PrepareContext<'_>, parameters: VolumeParameters, inner_level: u32) -> Faces {
    let defines = parameters.defines(&[("INNER_LEVEL", inner_level)]);
    let stages = vec![
        shader::glsl("methods/volumes/position.vert", &[]),
        shader::glsl("methods/triangle_ts/volume.tesc", &defines),
        shader::glsl("methods/triangle_ts/volume.tese", &defines),
    ];
    volumes::of_triangles(context, TRIANGLE_PATCH, stages)
}

/// The whole volume in one.
fn single(
    context: &PrepareContext<'_>,
    parameters: VolumeParameters,
    front_cap: FrontCap,
) -> Faces {
    let push: &[_] = match front_cap {
        FrontCap::Far => &[("PUSH_FRONT_CAP", 1)],
        FrontCap::InPlace => &[],
    };
    let defines = parameters.defines(push);
    let mut stages = vec![
        shader::glsl("methods/volumes/position.vert", &[]),
        shader::glsl("methods/triangle_ts/single.tesc", &defines),
        shader::glsl("methods/triangle_ts/single.tese", &defines),
    ];
    if front_cap == FrontCap::Far {
        stages.push(shader::glsl("methods/triangle_ts/push_front_cap.frag", &[]));
    }
    volumes::of_triangles(context, TRIANGLE_PATCH, stages)
}
