//! The faces of shadow volumes, and how native shader stages make them.

use super::counter::Counter;
use super::side_quad::DirectedEdge;
use super::volume_parameters::StageVolumeParameters;
use super::{MethodError, PrepareContext};
use crate::frame::{Frame, SceneBuffers};
use crate::geometry::silhouette::SilhouetteEdge;
use crate::gpu::DepthDirection;
use crate::gpu::native::{PrimitiveTopology, Raster, VertexInput};
use crate::gpu::shader::{self, Spirv};
use std::ops::Range;

/// Name of the stage that chooses which edges are asked.
pub(super) const SELECT_STAGE: &str = "select";

/// Faces of volumes that are drawn alike.
pub(super) struct Faces {
    /// The shader stages before the rasteriser, in their order.
    pub stages: Vec<Spirv>,
    /// What their fragments do besides being counted.
    pub fragments: Fragments,
    /// What a vertex is.
    pub input: VertexInput,
    /// What a primitive is.
    pub topology: PrimitiveTopology,
    /// What a draw takes.
    pub elements: Elements,
    /// Which elements each object that casts draws.
    pub draws: Draws,
    /// How they are counted in z-fail.
    pub z_fail: Raster,
    /// Whether they are drawn in z-pass. Caps, which are never in front of what is visible, need not be,
    /// and are only where they come with the sides in one draw.
    pub in_z_pass: bool,
}

/// What the first shader stage is given, by the number.
pub(super) enum Elements {
    /// Vertices, numbered as they are drawn.
    Vertices,
    /// Vertices by the indices of a buffer.
    Indices(wgpu::Buffer),
    /// What a task or mesh shader knows by a number, so many a workgroup. The caster's constants say where those of the draw
    /// begin and end.
    Workgroups(u32),
}

/// What the fragments of faces do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fragments {
    /// They count once.
    Count,
    /// They count as often as the last stage before the rasteriser says, where a counter takes weights.
    CountWeights,
    /// Those of a front cap go to the far plane; they count once.
    PushFrontCap,
}

impl Fragments {
    /// The fragment stage, if there must be one.
    pub(super) fn stage(self, parameters: &StageVolumeParameters, raster: Raster) -> Option<Spirv> {
        let counts = parameters.counter.takes_weights();
        let mut defines = Vec::new();
        if counts {
            // What a face adds that is seen from outside of its volume; from inside it takes it away.
            let adds = raster == Raster::CountDepthPasses;
            defines.push(("OUTSIDE_ADDS", u32::from(adds)));
        }
        if parameters.counter == Counter::StencilExport {
            defines.push(("IN_STENCIL", 1));
        }
        if self == Self::CountWeights {
            defines.push(("WEIGHTED", 1));
        }
        if parameters.depth == DepthDirection::Standard {
            defines.push(("STANDARD_DEPTH", 1));
        }
        let path = match self {
            Self::PushFrontCap => "methods/triangle_ts/push_front_cap.frag",
            Self::Count | Self::CountWeights if counts => "methods/volumes/count.frag",
            Self::Count | Self::CountWeights => return None,
        };
        Some(shader::glsl(path, &defines))
    }
}

/// Faces that `stages` make of each casting triangle, given as its three vertices.
pub(super) fn of_triangles(
    context: &PrepareContext<'_>,
    topology: PrimitiveTopology,
    stages: Vec<Spirv>,
) -> Result<Faces, MethodError> {
    let elements = |triangles: &Range<u32>| 3 * triangles.start..3 * triangles.end;
    Ok(Faces {
        stages,
        fragments: Fragments::Count,
        input: SceneBuffers::NATIVE_INPUT,
        topology,
        elements: Elements::Indices(context.indices()?),
        draws: Draws::All(context.casters.triangles().iter().map(elements).collect()),
        z_fail: Raster::CountDepthFails,
        in_z_pass: true,
    })
}

/// Front and back caps of all triangles, by a geometry shader. The back cap is behind everything,
/// tested or not.
pub(super) fn caps(context: &PrepareContext<'_>, parameters: &StageVolumeParameters) -> Faces {
    caps_with(context, parameters, &parameters.defines(&[]))
}

/// The same with other definitions for the shader.
pub(super) fn caps_with(
    context: &PrepareContext<'_>,
    parameters: &StageVolumeParameters,
    defines: &[(&str, u32)],
) -> Faces {
    Faces {
        stages: vec![
            shader::glsl("methods/volumes/index.vert", &[]),
            shader::glsl("methods/volumes/caps.geom", defines),
        ],
        fragments: Fragments::Count,
        input: VertexInput::Numbers,
        topology: PrimitiveTopology::Points,
        elements: Elements::Vertices,
        draws: Draws::All(context.casters.triangles()),
        z_fail: parameters.front_cap_raster(),
        in_z_pass: false,
    }
}

/// Side quads of the open edges, counted down: what is left of the count of triangles that face the light is that of the
/// others.
pub(super) fn open_edges(context: &PrepareContext<'_>) -> Result<Faces, MethodError> {
    let scene_casters = &context.casters;
    let mesh = &scene_casters.mesh;
    let mut corners = Vec::new();
    let casters = 0..mesh.caster_object_count();
    let draws = casters.map(|caster| {
        let start = corners.len() as u32;
        for &open in scene_casters.open_edges().of(caster) {
            let counted_down = SilhouetteEdge {
                multiplicity: -open.multiplicity,
                ..open
            };
            let edge = DirectedEdge::new(mesh, scene_casters.topology(), counted_down);
            for _ in 0..edge.multiplicity.unsigned_abs() {
                corners.extend(edge.quad(|vertex| 2 * vertex, |vertex| 2 * vertex + 1));
            }
        }
        start..corners.len() as u32
    });
    let draws = Draws::All(draws.collect());
    // A buffer cannot be empty.
    corners.resize(corners.len().max(1), 0);
    let usage = wgpu::BufferUsages::INDEX;
    let contents = bytemuck::cast_slice(&corners);
    Ok(Faces {
        stages: vec![shader::glsl("methods/volumes/corner.vert", &[])],
        fragments: Fragments::Count,
        input: VertexInput::Numbers,
        topology: PrimitiveTopology::Triangles,
        elements: Elements::Indices(context.gpu.buffer("the open edges", contents, usage)?),
        draws,
        z_fail: Raster::CountDepthFails,
        in_z_pass: true,
    })
}

/// Elements or vertices of each object that casts, in drawing order.
pub(super) enum Draws {
    /// The same in all frames.
    All(Vec<Range<u32>>),
    /// Those that a light leaves.
    Chosen(Box<dyn ChooseDraws>),
}

/// What brings the elements that a light leaves to the device.
pub(super) trait ChooseDraws {
    /// Chooses for a frame.
    ///
    /// # Errors
    /// When the device is lost.
    fn choose(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()>;
    /// What was chosen last.
    fn chosen(&self) -> &[Range<u32>];
}

impl Draws {
    pub(super) fn of_frame(&self) -> &[Range<u32>] {
        match self {
            Self::All(draws) => draws,
            Self::Chosen(draws) => draws.chosen(),
        }
    }
}
