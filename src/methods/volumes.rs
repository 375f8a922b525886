//! Shadow volumes counted in the stencil buffer: what all volume methods share.
//!
//! A method says which [`Faces`] its volumes have and how they are made; here they are drawn and
//! counted, z-fail, z-pass, or for each object whichever is right and draws less. The count of a pixel
//! is a sum over objects, so objects may be counted in different ways in one frame.

use super::limit::PRECISION_LIMIT;
use super::volume_parameters::{Counting, VolumeParameters};
use super::{Bound, Limit, MethodError, PrepareContext};
use crate::frame::{Frame, PreparedMethod, SceneBuffers, StencilResolve};
use crate::geometry::Bounds;
use crate::gpu::Capability;
use crate::gpu::native::{
    BindingKind, Bindings, IndexedGeometry, NativePass, Pipeline, PipelineDesc, PrimitiveTopology,
    Raster, Target, VertexInput,
};
use crate::gpu::shader::{self, Spirv};
use crate::metrics::Label;
use std::ops::Range;

/// Name of the stage that draws the volumes into the stencil buffer.
const VOLUMES_STAGE: &str = "volumes";

/// Name of the stage that chooses, on the processor, how each object is counted.
const CHOOSE_STAGE: &str = "choose";

/// What every volume method needs of the device.
pub(super) const STENCIL: Capability = Capability::StencilBuffer;

/// What every volume method cannot do.
pub(super) const LIMITS: &[Limit] = &[
    Limit {
        text: "8-bit counter: wrong where a point lies in 256 single-triangle shadow volumes or a multiple of \
               that; a closed surface counts as two",
        with: &[],
        fails: &[],
        kinds: &[Label::Overflow],
        at_most: Bound::All,
    },
    Limit {
        text: "counting=z_pass: wrong where the eye or part of the near rectangle lies in a shadow volume",
        with: &[("counting", "z_pass")],
        fails: &[
            ("eye_in_volume", 0.45),
            ("near_plane_cuts_caster", 1.5),
            ("light_in_mesh", 0.5),
            ("light_in_lantern", 0.6),
            ("light_near_face", 1.0),
            ("light_on_element", 1.0),
        ],
        kinds: &[],
        at_most: Bound::All,
    },
    Limit {
        text: "determinism=none: leaks where a triangle is nearly edge-on to the light and its edges disagree",
        with: &[("determinism", "none")],
        fails: &[
            ("edge_on", 0.0),
            ("collinear", 0.01),
            ("needles", 7.0),
            ("light_near_vertex", 7.0),
        ],
        kinds: &[],
        at_most: Bound::Share(0.6),
    },
    Limit {
        text: "front_cap=in_place: wrong in any scene, mostly acne, where the depths of a cap and of its own surface \
               differ in the last bit; push_back_px removes most of it",
        with: &[("front_cap", "in_place")],
        fails: &[],
        kinds: &[
            Label::Acne,
            Label::Leak,
            Label::Seam,
            Label::Grazing,
            Label::DetachedShadow,
            Label::Inverted,
            Label::Unlabelled,
        ],
        at_most: Bound::Share(0.8),
    },
    Limit {
        text: "depth=standard: far from the eye, the depth buffer cannot separate volumes from the surfaces they \
               start from",
        with: &[("depth", "standard")],
        fails: &[
            ("far_casters", 5.0),
            ("large_triangles", 5.0),
            ("translation", 5.0),
        ],
        kinds: &[Label::Acne, Label::Seam, Label::Grazing, Label::Unlabelled],
        at_most: Bound::Share(0.05),
    },
    Limit::in_words(
        "a line of wrong pixels along the edge between two triangles that reach 10,000 times as far as what the \
         picture shows: both are clipped there, and their caps overlap or leave a gap",
    ),
    PRECISION_LIMIT,
    Limit {
        text: "a wrong pixel or two beside a clipped edge, or beside an edge whose side quad has the same depth as \
               the surface after rounding, in about one of a thousand random scenes",
        with: &[],
        fails: &[],
        kinds: &[Label::Unlabelled],
        at_most: Bound::Px(2),
    },
    Limit {
        text: "single wrong pixels where a side quad lies in the surface it starts from, but for the last bit of \
               depth: on surfaces edge-on to the light, and where coplanar triangles overlap",
        with: &[],
        fails: &[("coplanar_overlap", 64.0)],
        kinds: &[Label::Grazing],
        at_most: Bound::Px(16),
    },
];

/// What volumes of single triangles cannot do.
pub(super) const TRIANGLE_LIMITS: &[Limit] = &[Limit {
    text: "single wrong pixels at edges between triangles, where the side quads of both should cancel; \
           anywhere in the picture where hundreds of such edges cast shadows",
    with: &[],
    fails: &[("nested_shells", 129.0)],
    kinds: &[Label::Seam],
    at_most: Bound::Px(16),
}];

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
pub(super) fn caps(context: &PrepareContext<'_>, parameters: &VolumeParameters) -> Faces {
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
