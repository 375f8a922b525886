//! Shadow volumes of triangles with adjacency, in a geometry shader: each triangle asks its neighbours (Stich, Wächter and
//! Keller 2007, GPU Gems 3, chapter 11).
//!
//! Their shader emits caps in the same call. Here, as in all volume methods, these are drawn apart, since those in front
//! are counted without a depth test.

mod adjacency;

use super::counter::Counter;
use super::faces::{self, Draws, Elements, Faces, Fragments};
use super::volume_parameters::{
    Counting, Plan, StageVolumeParameters, VolumeParameters, refuse_both,
};
use super::volumes::{STENCIL, StencilVolumes};
use super::{Bound, Clash, Effect, Limit};
use super::{MethodError, MethodInfo, PrepareContext, ShadowMethod, clash, volume_limits};
use crate::frame::{DepthSetup, PreparedMethod};
use crate::geometry::{Casting, Determinism};
use crate::gpu::Capability;
use crate::gpu::native::{PrimitiveTopology, Raster, VertexInput};
use crate::gpu::shader;
use crate::parameters;
use adjacency::Adjacency;
use serde::{Deserialize, Serialize};

/// What the method is.
pub(super) static INFO: MethodInfo = MethodInfo {
    id: "adjacency_gs",
    title: "shadow volumes of triangles with adjacency, by a geometry shader",
    source: "Stich, Wächter, Keller 2007 (GPU Gems 3, chapter 11)",
    needs: &[Capability::GeometryStage, STENCIL],
    limits: &[volume_limits::LIMITS, LIMITS],
    clashes: CLASHES,
    tolerated_share: 0.0,
};

const LIMITS: &[Limit] = &[
    Limit {
        with: &[("mode", "two_manifold_unchecked")],
        ..Limit::in_words(
            "mode=two_manifold_unchecked: wrong where surfaces are open, meet in more than one other, or turn over",
        )
    },
    Limit {
        text: "determinism=any_corner: wrong where the light lies in the plane of a triangle and is no farther from it \
               than it is large: the triangle then casts a shadow",
        with: &[("determinism", "any_corner")],
        unless: &[],
        fails: &[("light_on_element", 1.0)],
        kinds: &[],
        at_most: Bound::Share(0.15),
    },
];

const CLASHES: &[Clash] = &[
    clash::PLAN,
    clash::Z_FAIL,
    clash::Z_PASS,
    Clash {
        beside: ("plan", "auto"),
        parameters: &["mode", "determinism=any_corner"],
        effect: Effect::Refused,
        why: "the plan decides what casts, and counts the volumes around the near rectangle",
    },
    Clash {
        beside: ("determinism", "any_corner"),
        parameters: &["counting=z_pass_counted"],
        effect: Effect::Refused,
        why: "the volumes around the near rectangle are counted on the processor, by the reference edge",
    },
];

/// Which triangles have volumes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Mode {
    /// Of closed objects with eye and light outside those that face the light, of others all.
    #[default]
    Auto,
    /// All.
    Robust,
    /// Those that face the light, of closed objects alone.
    TwoManifold,
    /// The same of any object.
    TwoManifoldUnchecked,
}

/// How a triangle and its neighbours agree on its facing.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Agreement {
    #[default]
    ReferenceEdge,
    /// Stich et al. 2007, section 11.3.2.
    AnyCorner,
}

impl Agreement {
    /// `DETERMINISM` of the shaders.
    fn number(self) -> u32 {
        match self {
            Self::ReferenceEdge => Determinism::ReferenceEdge as u32,
            Self::AnyCorner => 3,
        }
    }
}

parameters! {
    /// The method's parameters.
    pub(super) struct AdjacencyGs {
        mode: Mode = Mode::Auto,
            "which triangles have volumes: auto (of closed objects with eye and light outside those that face the light, of \
             others all), robust (all), two_manifold (those that face the light; refused where an object is not closed), \
             two_manifold_unchecked (the same of any object, for study)";
        determinism: Agreement = Agreement::ReferenceEdge,
            "how a triangle and its neighbours agree on its facing: reference_edge; any_corner (it faces the light if that \
             is so at any of its corners)";
        counter: Counter = Counter::Stencil8,
            "where volumes are counted: stencil8 (0 again at 256), stencil_export (the same by fragment shaders, twice: 0 \
             again at 65,280), blend16, blend32 (floats, by blending)";
        ..volume: VolumeParameters;
    }
}

impl AdjacencyGs {
    fn stage_parameters(&self) -> StageVolumeParameters {
        let casting = match self.mode {
            Mode::Robust => Casting::All,
            Mode::Auto | Mode::TwoManifold | Mode::TwoManifoldUnchecked => Casting::LightFacing,
        };
        StageVolumeParameters::new(self.volume, casting, self.counter)
    }

    /// As [`StageVolumeParameters::planned`].
    fn planned(&self, context: &PrepareContext<'_>) -> Result<StageVolumeParameters, MethodError> {
        let mut parameters = self.stage_parameters();
        if self.volume.plan == Plan::Auto {
            refuse_both("mode", self.mode != Mode::Auto)?;
            parameters.casting = StageVolumeParameters::default().casting;
        }
        let planned = parameters.planned(&context.scene.flight.light)?;
        if self.determinism == Agreement::AnyCorner && planned.counting == Counting::ZPassCounted {
            let message = "determinism=any_corner: the volumes around the near rectangle are counted by the reference \
                           edge; use another counting than z_pass_counted, and no plan";
            return Err(MethodError::Parameter(message.to_owned()));
        }
        Ok(planned)
    }

    fn check_closed(&self, context: &PrepareContext<'_>) -> Result<(), MethodError> {
        let closed = context.casters.are_closed();
        let open = closed.iter().filter(|is_closed| !**is_closed).count();
        if self.mode != Mode::TwoManifold || open == 0 {
            return Ok(());
        }
        Err(MethodError::Unavailable(format!(
            "mode=two_manifold: {open} of {} objects are not closed and consistently wound: use mode=auto or robust",
            closed.len()
        )))
    }
}

impl ShadowMethod for AdjacencyGs {
    fn info(&self) -> &'static MethodInfo {
        &INFO
    }

    fn depth_setup(&self) -> DepthSetup {
        self.stage_parameters().depth_setup()
    }

    fn prepare(
        &self,
        context: &PrepareContext<'_>,
    ) -> Result<Box<dyn PreparedMethod>, MethodError> {
        self.check_closed(context)?;
        let parameters = &self.planned(context)?;
        let context = &parameters.casters(context)?;
        let adjacency = Adjacency::new(&context.casters);
        let light = context.scene.flight.at(0.0).light.place;
        let counters = vec![
            ("cut_edges", adjacency.cut.len() as u64),
            (
                "extra_side_quads",
                adjacency.extra_side_quads(&context.casters, light),
            ),
        ];
        let defines = parameters.defines_with(self.determinism.number(), &[]);
        let sides = sides(context, &adjacency, &defines)?;
        let faces = vec![sides, faces::caps_with(context, parameters, &defines)];
        let mut volumes = StencilVolumes::new(context, parameters, &[], faces, counters)?;
        if self.mode == Mode::TwoManifoldUnchecked {
            volumes.take_all_as_closed();
        }
        Ok(Box::new(volumes))
    }
}

fn sides(
    context: &PrepareContext<'_>,
    adjacency: &Adjacency,
    defines: &[(&str, u32)],
) -> Result<Faces, MethodError> {
    let mut vertices = adjacency.vertices.as_flattened().to_vec();
    // A buffer cannot be empty.
    vertices.resize(vertices.len().max(1), 0);
    let contents = bytemuck::cast_slice(&vertices);
    let usage = wgpu::BufferUsages::INDEX;
    let triangles = context.casters.triangles();
    let elements = |own: &std::ops::Range<u32>| 6 * own.start..6 * own.end;
    let name = "the triangles with adjacency";
    Ok(Faces {
        stages: vec![
            shader::glsl("methods/adjacency_gs/corner.vert", &[]),
            shader::glsl("methods/adjacency_gs/sides.geom", defines),
        ],
        fragments: Fragments::Count,
        input: VertexInput::Numbers,
        topology: PrimitiveTopology::TrianglesWithAdjacency,
        elements: Elements::Indices(context.gpu.buffer(name, contents, usage)?),
        draws: Draws::All(triangles.iter().map(elements).collect()),
        z_fail: Raster::CountDepthFails,
        in_z_pass: true,
    })
}
