//! Shadow volumes counted in the stencil buffer: what all volume methods share.
//!
//! A method says which [`Faces`] its volumes have and how they are made; here they are drawn and
//! counted, z-fail, z-pass, or for each object whichever is right and draws less. The count of a pixel
//! is a sum over objects, so objects may be counted in different ways in one frame.

use super::volume_parameters::{Counting, StageVolumeParameters, VolumeParameters};
use super::{MethodError, PrepareContext};
use crate::frame::{Frame, PreparedMethod, SceneBuffers, StencilResolve};
use crate::geometry::Bounds;
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

/// What every volume method needs of the device.
pub(super) const STENCIL: Capability = Capability::StencilBuffer;

/// Faces of volumes that are drawn alike.
pub(super) struct Faces {
    /// All shader stages, the vertex stage first.
    pub stages: Vec<Spirv>,
    /// What a primitive is.
    pub topology: PrimitiveTopology,
    /// Element buffer into the scene's positions; without one, vertices are plain numbers.
    pub indices: Option<wgpu::Buffer>,
    /// Elements or vertices of each object that casts, in drawing order.
    pub draws: Vec<Range<u32>>,
    /// How they are counted in z-fail.
    pub z_fail: Raster,
    /// Whether they are drawn in z-pass. Caps, which are never in front of what is visible, need not be,
    /// and are only where they come with the sides in one draw.
    pub in_z_pass: bool,
}

impl Faces {
    fn input(&self) -> VertexInput {
        match self.indices {
            Some(_) => VertexInput::Positions {
                stride: SceneBuffers::VERTEX_STRIDE as u32,
            },
            None => VertexInput::Numbers,
        }
    }
}

/// Faces that `stages` make of each casting triangle, given as its three vertices.
pub(super) fn of_triangles(
    context: &PrepareContext<'_>,
    topology: PrimitiveTopology,
    stages: Vec<Spirv>,
) -> Faces {
    let scene = &context.resources.scene;
    let elements = |triangles: &Range<u32>| 3 * triangles.start..3 * triangles.end;
    Faces {
        stages,
        topology,
        indices: Some(scene.indices.clone()),
        draws: scene.casters.iter().map(elements).collect(),
        z_fail: Raster::CountDepthFails,
        in_z_pass: true,
    }
}

/// Front and back caps of all triangles, by a geometry shader. The back cap is behind everything,
/// tested or not.
pub(super) fn caps(context: &PrepareContext<'_>, parameters: &StageVolumeParameters) -> Faces {
    Faces {
        stages: vec![
            shader::glsl("methods/volumes/index.vert", &[]),
            shader::glsl("methods/volumes/caps.geom", &parameters.defines(&[])),
        ],
        topology: PrimitiveTopology::Points,
        indices: None,
        draws: context.resources.scene.casters.clone(),
        z_fail: parameters.front_cap_raster(),
        in_z_pass: false,
    }
}

/// Faces ready to be drawn.
struct PreparedFaces {
    z_fail: Option<Pipeline>,
    z_pass: Option<Pipeline>,
    geometry: Option<IndexedGeometry>,
    draws: Vec<Range<u32>>,
}

/// The shadow volumes of one scene.
pub(super) struct StencilVolumes {
    counting: Counting,
    faces: Vec<PreparedFaces>,
    bindings: Bindings,
    target: Target,
    resolve: StencilResolve,
    counters: Vec<(&'static str, u64)>,
}

impl StencilVolumes {
    /// Builds the pipelines of `faces`, drawn in their order. `buffers` are what shaders read at
    /// bindings 3, 4, ... (0 to 2 are frame, positions and indices); `counters` are told to the user.
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &VolumeParameters,
        buffers: &[wgpu::Buffer],
        faces: Vec<Faces>,
        counters: Vec<(&'static str, u64)>,
    ) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = context;
        let device = &gpu.device;
        let counting = parameters.counting;
        let target = Target::new(device, &resources.targets.depth, parameters.depth)?;
        let mut bound = vec![
            (BindingKind::Uniform, &resources.uniform.buffer),
            (BindingKind::Storage, &resources.scene.positions),
            (BindingKind::Storage, &resources.scene.indices),
        ];
        bound.extend(buffers.iter().map(|buffer| (BindingKind::Storage, buffer)));
        let bindings = Bindings::new(device, &bound)?;
        let prepare = |faces: Faces| {
            let pipeline = |raster| {
                let desc = PipelineDesc {
                    stages: &faces.stages,
                    input: faces.input(),
                    topology: faces.topology,
                    raster,
                    push_back_px: parameters.push_back_px as f32,
                };
                Pipeline::new(device, &target, &bindings, &desc)
            };
            let z_pass = faces.in_z_pass && counting != Counting::ZFail;
            Ok::<_, MethodError>(PreparedFaces {
                z_fail: (counting != Counting::ZPass)
                    .then(|| pipeline(faces.z_fail))
                    .transpose()?,
                z_pass: z_pass
                    .then(|| pipeline(Raster::CountDepthPasses))
                    .transpose()?,
                geometry: faces
                    .indices
                    .as_ref()
                    .map(|indices| {
                        IndexedGeometry::new(device, &resources.scene.positions, indices)
                    })
                    .transpose()?,
                draws: faces.draws,
            })
        };
        Ok(Self {
            counting,
            faces: faces.into_iter().map(prepare).collect::<Result<_, _>>()?,
            bindings,
            target,
            resolve: StencilResolve::new(gpu, parameters.depth_setup()),
            counters,
        })
    }

    /// Which of the objects that cast are counted z-pass in the frame under way.
    fn objects_in_z_pass(&self, frame: &mut Frame<'_>) -> Vec<bool> {
        let casters = &frame.resources().extents.casters;
        match self.counting {
            Counting::ZFail => vec![false; casters.len()],
            Counting::ZPass => vec![true; casters.len()],
            Counting::Auto => {
                let view = *frame.view();
                let may_pass = || {
                    let near_volume = view.near_volume();
                    let may_pass = |bounds: &Bounds| !near_volume.may_meet(*bounds);
                    casters.iter().map(may_pass).collect()
                };
                frame.stage(CHOOSE_STAGE, |stage| stage.on_processor(may_pass))
            }
        }
    }

    /// Draws the objects of each way of counting, faces after faces.
    fn draw(&self, pass: &mut NativePass<'_>, in_z_pass: &[bool]) {
        for faces in &self.faces {
            if let Some(geometry) = &faces.geometry {
                pass.set_geometry(geometry);
            }
            for (pipeline, is_z_pass) in [(&faces.z_fail, false), (&faces.z_pass, true)] {
                let Some(pipeline) = pipeline else { continue };
                pass.set_pipeline(pipeline);
                let objects = faces.draws.iter().zip(in_z_pass);
                for (draw, _) in objects.filter(|(_, z_pass)| **z_pass == is_z_pass) {
                    match faces.geometry {
                        Some(_) => pass.draw_indexed(draw.clone()),
                        None => pass.draw(draw.clone()),
                    }
                }
            }
        }
    }
}

impl PreparedMethod for StencilVolumes {
    fn record(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let in_z_pass = self.objects_in_z_pass(frame);
        frame.stage(VOLUMES_STAGE, |stage| {
            stage.native(&self.target, &self.bindings, |pass| {
                self.draw(pass, &in_z_pass);
            });
        });
        self.resolve.record(frame);
        Ok(())
    }

    fn counters(&self) -> Vec<(&'static str, u64)> {
        self.counters.clone()
    }
}
