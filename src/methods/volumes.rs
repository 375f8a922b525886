//! Shadow volumes counted in the stencil buffer: what all volume methods share.
//!
//! A method says which [`Faces`] its volumes have and how they are made; here they are drawn and
//! counted, z-fail, z-pass, or for each object whichever is right and draws less. The count of a pixel
//! is a sum over objects, so objects may be counted in different ways in one frame.

use super::plan::{CasterPlan, FramePlan, Planner};
use super::side_quad::DirectedEdge;
use super::volume_parameters::{Counting, StageVolumeParameters, VolumeParameters};
use super::{MethodError, PrepareContext};
use crate::frame::{
    DrawnVolumes, Frame, PreparedMethod, RESOLVE_STAGE, SceneBuffers, StencilResolve,
};
use crate::geometry::Casting;
use crate::geometry::silhouette::SilhouetteEdge;
use crate::gpu::Capability;
use crate::gpu::native::{
    BindingKind, Bindings, IndexedGeometry, NativePass, Pipeline, PipelineDesc, PrimitiveTopology,
    Raster, Target, VertexInput,
};
use crate::gpu::shader::{self, Spirv};
use std::ops::Range;

/// Name of the stage that draws the volumes into the stencil buffer.
pub(super) const VOLUMES_STAGE: &str = "volumes";

/// Name of the stage that chooses, on the processor, how each object is counted.
pub(super) const CHOOSE_STAGE: &str = "choose";

/// Name of the stage that goes on to count what does not face the light, by open edges.
pub(super) const OPEN_EDGES_STAGE: &str = "open_edges";

/// Name of the stage that adds to the mask what that has counted.
pub(super) const RESOLVE_REST_STAGE: &str = "resolve_rest";

/// What every volume method needs of the device.
pub(super) const STENCIL: Capability = Capability::StencilBuffer;

/// Faces of volumes that are drawn alike.
pub(super) struct Faces {
    /// All shader stages, the vertex stage first.
    pub stages: Vec<Spirv>,
    /// What a vertex is.
    pub input: VertexInput,
    /// What a primitive is.
    pub topology: PrimitiveTopology,
    /// The elements; without them, vertices are numbered as they are drawn.
    pub indices: Option<wgpu::Buffer>,
    /// Which of them each object that casts draws.
    pub draws: Draws,
    /// How they are counted in z-fail.
    pub z_fail: Raster,
    /// Whether they are drawn in z-pass. Caps, which are never in front of what is visible, need not be,
    /// and are only where they come with the sides in one draw.
    pub in_z_pass: bool,
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
        input: SceneBuffers::NATIVE_INPUT,
        topology,
        indices: Some(context.indices()?),
        draws: Draws::All(context.casters.triangles().iter().map(elements).collect()),
        z_fail: Raster::CountDepthFails,
        in_z_pass: true,
    })
}

/// Front and back caps of all triangles, by a geometry shader. The back cap is behind everything,
/// tested or not.
pub(super) fn caps(context: &PrepareContext<'_>, parameters: &StageVolumeParameters) -> Faces {
    Faces {
        stages: vec![
            shader::glsl("methods/volumes/index.vert", &[]),
            shader::glsl("methods/volumes/caps.geom", &parameters.defines(&[])),
        ],
        input: VertexInput::Numbers,
        topology: PrimitiveTopology::Points,
        indices: None,
        draws: Draws::All(context.casters.triangles()),
        z_fail: parameters.front_cap_raster(),
        in_z_pass: false,
    }
}

/// Side quads of the open edges, counted down: what is left of the count of triangles that face the light is that of the
/// others.
fn open_edges(context: &PrepareContext<'_>) -> Result<Faces, MethodError> {
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
        input: VertexInput::Numbers,
        topology: PrimitiveTopology::Triangles,
        indices: Some(context.gpu.buffer("the open edges", contents, usage)?),
        draws,
        z_fail: Raster::CountDepthFails,
        in_z_pass: true,
    })
}

/// Faces ready to be drawn.
struct PreparedFaces {
    z_fail: Option<Pipeline>,
    z_pass: Option<Pipeline>,
    geometry: Option<IndexedGeometry>,
    draws: Draws,
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
    fn of_frame(&self) -> &[Range<u32>] {
        match self {
            Self::All(draws) => draws,
            Self::Chosen(draws) => draws.chosen(),
        }
    }
}

/// The shadow volumes of one scene.
pub(super) struct StencilVolumes {
    planner: Planner,
    faces: Vec<PreparedFaces>,
    /// Drawn after what the others have counted is in the mask.
    open_edges: Option<PreparedFaces>,
    bindings: Bindings,
    target: Target,
    resolve: StencilResolve,
    counters: Vec<(&'static str, u64)>,
    /// Of the last frame.
    plan: FramePlan,
}

impl StencilVolumes {
    /// Builds the pipelines of `faces`, drawn in their order. `buffers` are what shaders read at
    /// bindings 3, 4, ... (0 to 2 are frame, positions and indices); `counters` are told to the user.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &StageVolumeParameters,
        buffers: &[wgpu::Buffer],
        faces: Vec<Faces>,
        counters: Vec<(&'static str, u64)>,
    ) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = context;
        let device = &gpu.device;
        let counting = parameters.counting;
        let target = Target::new(device, &resources.targets.depth, parameters.depth)?;
        let indices = context.indices()?;
        let mut bound = vec![
            (BindingKind::Uniform, &resources.uniform.buffer),
            (BindingKind::Storage, &resources.scene.positions),
            (BindingKind::Storage, &indices),
        ];
        bound.extend(buffers.iter().map(|buffer| (BindingKind::Storage, buffer)));
        let bindings = Bindings::new(device, &bound)?;
        let prepare =
            |faces: Faces| PreparedFaces::new(context, (&target, &bindings), parameters, faces);
        Ok(Self {
            planner: Planner::new(
                context,
                **parameters,
                parameters.casting,
                parameters.determinism,
            ),
            faces: faces.into_iter().map(prepare).collect::<Result<_, _>>()?,
            open_edges: (parameters.casting == Casting::EachSide && counting != Counting::ZFail)
                .then(|| prepare(open_edges(context)?))
                .transpose()?,
            bindings,
            target,
            resolve: StencilResolve::new(gpu, parameters.depth_setup()),
            counters,
            plan: FramePlan::default(),
        })
    }

    /// Draws the objects of each way of counting, faces after faces.
    fn draw(&self, pass: &mut NativePass<'_>, plan: &FramePlan) {
        for faces in &self.faces {
            faces.draw(pass, &plan.casters, |_| true);
        }
    }
}

impl PreparedFaces {
    fn new(
        context: &PrepareContext<'_>,
        (target, bindings): (&Target, &Bindings),
        parameters: &VolumeParameters,
        faces: Faces,
    ) -> Result<Self, MethodError> {
        let device = &context.gpu.device;
        let pipeline = |raster| {
            let desc = PipelineDesc {
                stages: &faces.stages,
                input: faces.input,
                topology: faces.topology,
                raster,
                push_back_px: parameters.push_back_px as f32,
            };
            Pipeline::new(device, target, bindings, &desc)
        };
        let geometry = |indices| {
            let positions = &context.resources.scene.positions;
            IndexedGeometry::new(device, positions, indices)
        };
        let z_pass = faces.in_z_pass && parameters.counting != Counting::ZFail;
        Ok(Self {
            z_fail: (parameters.counting != Counting::ZPass)
                .then(|| pipeline(faces.z_fail))
                .transpose()?,
            z_pass: z_pass
                .then(|| pipeline(Raster::CountDepthPasses))
                .transpose()?,
            geometry: faces.indices.as_ref().map(geometry).transpose()?,
            draws: faces.draws,
        })
    }

    /// Draws the objects that `takes` takes, those of each way of counting together.
    fn draw(
        &self,
        pass: &mut NativePass<'_>,
        casters: &[CasterPlan],
        takes: impl Fn(&CasterPlan) -> bool,
    ) {
        if let Some(geometry) = &self.geometry {
            pass.set_geometry(geometry);
        }
        for (pipeline, is_z_pass) in [(&self.z_fail, false), (&self.z_pass, true)] {
            let Some(pipeline) = pipeline else { continue };
            pass.set_pipeline(pipeline);
            let is_drawn =
                |plan: &CasterPlan| plan.is_drawn && plan.z_pass == is_z_pass && takes(plan);
            let objects = self.draws.of_frame().iter().zip(casters);
            for (draw, plan) in objects.filter(|(_, plan)| is_drawn(plan)) {
                pass.set_constants(constants(*plan));
                match self.geometry {
                    Some(_) => pass.draw_indexed(draw.clone()),
                    None => pass.draw(draw.clone()),
                }
            }
        }
    }
}

/// Twin of `Caster` in shaders/shared/caster.glsl.
fn constants(plan: CasterPlan) -> [u32; 4] {
    let light_facing_only = u32::from(plan.casting != Casting::All);
    [plan.end.index() as u32, light_facing_only, 0, 0]
}

impl PreparedMethod for StencilVolumes {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let (view, casters) = (*frame.view(), &frame.resources().extents.casters);
        let plan = frame.stage(CHOOSE_STAGE, |stage| {
            stage.on_processor(|| self.planner.plan(&view, casters))
        });
        for faces in &mut self.faces {
            if let Draws::Chosen(draws) = &mut faces.draws {
                draws.choose(frame)?;
            }
        }
        frame.stage(VOLUMES_STAGE, |stage| {
            stage.native(&self.target, &self.bindings, |pass| {
                self.draw(pass, &plan);
            });
        });
        self.resolve.record(frame, RESOLVE_STAGE, plan.near_count);
        if let (Some(open_edges), Some(near_count)) = (&self.open_edges, plan.near_count_of_rest) {
            frame.stage(OPEN_EDGES_STAGE, |stage| {
                stage.native(&self.target, &self.bindings, |pass| {
                    let takes = |plan: &CasterPlan| plan.casting == Casting::EachSide;
                    open_edges.draw(pass, &plan.casters, takes);
                });
            });
            self.resolve.record(frame, RESOLVE_REST_STAGE, near_count);
        }
        self.plan = plan;
        Ok(())
    }

    fn drawn_volumes(&self) -> Option<DrawnVolumes> {
        Some(self.plan.drawn())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        self.counters.clone()
    }
}
