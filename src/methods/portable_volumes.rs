//! Shadow volumes whose faces a vertex shader makes of numbers, counted by wgpu's own passes: no native stage.

use super::corner::Weights;
use super::counter::{Counter, Counts};
use super::volume_parameters::{PortableVolumeParameters, VolumeParameters};
use super::{MethodError, PrepareContext};
use crate::frame::FrameResources;
use crate::gpu::{DepthDirection, Stage, shader};
use std::ops::Range;
use wgpu::StencilOperation::{DecrementWrap, IncrementWrap};

/// How the pixels of a face count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Count {
    /// Where the face is behind what is visible: z-fail.
    DepthFails,
    /// Where it is in front, with opposite signs: z-pass.
    DepthPasses,
    /// Everywhere, as z-fail does behind all.
    Everywhere,
}

impl Count {
    /// What a face that is seen from outside counts.
    fn of_front_face(self) -> f64 {
        match self {
            Self::DepthPasses => 1.0,
            Self::DepthFails | Self::Everywhere => -1.0,
        }
    }
}

/// The faces of each way of counting, as corners of an element buffer: three corners a triangle, counter-clockwise seen from
/// outside of the volume.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Corners {
    pub(super) depth_passes: FaceDraws,
    pub(super) depth_fails: FaceDraws,
    pub(super) everywhere: FaceDraws,
    /// Counted after the others are in the mask, where depth passes.
    pub(super) of_open_edges: FaceDraws,
}

/// How faces are drawn.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum FaceDraws {
    /// These corners, in a call.
    Corners(Range<u32>),
    /// As the device has counted them: these draws of a buffer, a call each.
    Indirect(wgpu::Buffer, Range<u32>),
    /// Without elements: these vertices, a call for each range.
    Vertices(Vec<Range<u32>>),
}

/// Name of the stage that finds silhouettes.
pub(super) const EXTRACT_STAGE: &str = "extract";

/// Bytes of an indirect draw: five numbers of 32 bits.
pub(super) const INDIRECT_BYTES: u64 = 20;

impl FaceDraws {
    /// No face.
    pub(super) const NONE: Self = Self::Corners(0..0);

    fn is_empty(&self) -> bool {
        match self {
            Self::Corners(range) | Self::Indirect(_, range) => range.is_empty(),
            Self::Vertices(ranges) => ranges.is_empty(),
        }
    }

    /// Gives the number of draw calls.
    fn record(&self, pass: &mut wgpu::RenderPass<'_>) -> u32 {
        match self {
            Self::Corners(corners) => {
                pass.draw_indexed(corners.clone(), 0, 0..1);
                1
            }
            Self::Indirect(draws, range) => {
                for draw in range.clone() {
                    pass.draw_indexed_indirect(draws, INDIRECT_BYTES * u64::from(draw));
                }
                range.len() as u32
            }
            Self::Vertices(ranges) => {
                for vertices in ranges {
                    pass.draw(vertices.clone(), 0..1);
                }
                ranges.len() as u32
            }
        }
    }
}

/// The vertex stage that makes corners of elements, with what it reads beside the frame.
pub(super) struct CornerStage<'a> {
    /// A file below `shaders/`.
    pub(super) path: &'a str,
    pub(super) entry_point: &'a str,
    pub(super) constants: &'a [(&'a str, f64)],
    /// Of group 1.
    pub(super) layout: &'a wgpu::BindGroupLayout,
    pub(super) bind_group: &'a wgpu::BindGroup,
}

/// The pipelines.
pub(super) struct PortableVolumes {
    depth_passes: wgpu::RenderPipeline,
    depth_fails: wgpu::RenderPipeline,
    everywhere: wgpu::RenderPipeline,
    bind_group: wgpu::BindGroup,
    pub(super) counts: Counts,
}

impl PortableVolumes {
    /// For faces that are lists of corners, by their [numbers](super::corner).
    pub(super) fn of_corners(
        context: &PrepareContext<'_>,
        parameters: &PortableVolumeParameters,
        weights: Weights,
    ) -> Result<Self, MethodError> {
        let scene = &context.resources.scene;
        let takes_weights = Counter::from(parameters.counter).takes_weights();
        let vertex_bits = [("vertex_bits", f64::from(weights.vertex_bits))];
        let stage = CornerStage {
            path: "methods/volumes/corner.wgsl",
            entry_point: if takes_weights {
                "weighted_corner"
            } else {
                "corner"
            },
            constants: if takes_weights { &vertex_bits } else { &[] },
            layout: &scene.layout,
            bind_group: &scene.bind_group,
        };
        Self::new(context, parameters, &stage)
    }

    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &PortableVolumeParameters,
        stage: &CornerStage<'_>,
    ) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = context;
        let device = &gpu.device;
        let modules = Modules {
            corners: shader::wgsl(device, stage.path),
            count: shader::wgsl(device, "methods/volumes/count.wgsl"),
            layout: device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("volumes"),
                bind_group_layouts: &[Some(&resources.uniform.layout), Some(stage.layout)],
                ..Default::default()
            }),
        };
        let counts = Counts::new(context, parameters.counter.into(), parameters.depth_setup())?;
        let target = counts.target();
        let depth_format = resources.targets.depth.format();
        let pipeline = |count| {
            let mut tests = depth_stencil(count, depth_format, parameters);
            if target.is_some() {
                count_in_shader(count, &mut tests);
            }
            modules.pipeline(device, stage, count, tests, target.as_ref())
        };
        Ok(Self {
            depth_passes: pipeline(Count::DepthPasses),
            depth_fails: pipeline(Count::DepthFails),
            everywhere: pipeline(Count::Everywhere),
            bind_group: stage.bind_group.clone(),
            counts,
        })
    }

    /// Counts the faces whose corners are in `elements`, but for those of open edges.
    pub(super) fn record(
        &self,
        stage: &mut Stage<'_, '_>,
        resources: &FrameResources,
        elements: Option<&wgpu::Buffer>,
        corners: &Corners,
    ) {
        let draws = [
            (&self.depth_passes, &corners.depth_passes),
            (&self.depth_fails, &corners.depth_fails),
            (&self.everywhere, &corners.everywhere),
        ];
        self.draw(stage, resources, elements, &draws);
    }

    /// Goes on counting with those.
    pub(super) fn record_open_edges(
        &self,
        stage: &mut Stage<'_, '_>,
        resources: &FrameResources,
        elements: Option<&wgpu::Buffer>,
        corners: &Corners,
    ) {
        let draws = [(&self.depth_passes, &corners.of_open_edges)];
        self.draw(stage, resources, elements, &draws);
    }

    fn draw(
        &self,
        stage: &mut Stage<'_, '_>,
        resources: &FrameResources,
        elements: Option<&wgpu::Buffer>,
        draws: &[(&wgpu::RenderPipeline, &FaceDraws)],
    ) {
        let mut pass = pass(stage, resources, self.counts.attachment());
        pass.set_bind_group(0, &resources.uniform.bind_group, &[]);
        pass.set_bind_group(1, &self.bind_group, &[]);
        if let Some(elements) = elements {
            pass.set_index_buffer(elements.slice(..), wgpu::IndexFormat::Uint32);
        }
        pass.set_stencil_reference(0);
        let mut draw_calls = 0;
        for (pipeline, faces) in draws.iter().filter(|(_, faces)| !faces.is_empty()) {
            pass.set_pipeline(pipeline);
            draw_calls += faces.record(&mut pass);
        }
        drop(pass);
        stage.count_draws(draw_calls);
    }
}

/// What pipelines are made of.
struct Modules {
    corners: wgpu::ShaderModule,
    count: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
}

impl Modules {
    /// A pipeline that counts faces: in the stencil by its tests, or in a target by a fragment shader.
    fn pipeline(
        &self,
        device: &wgpu::Device,
        stage: &CornerStage<'_>,
        count: Count,
        tests: wgpu::DepthStencilState,
        target: Option<&wgpu::ColorTargetState>,
    ) -> wgpu::RenderPipeline {
        let targets = [target.cloned()];
        let constants = [("seen_from_outside", count.of_front_face())];
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("volumes"),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.corners,
                entry_point: Some(stage.entry_point),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: stage.constants,
                    ..Default::default()
                },
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(tests),
            multisample: wgpu::MultisampleState::default(),
            fragment: target.map(|_| wgpu::FragmentState {
                module: &self.count,
                entry_point: Some("count"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// A pass over depth and stencil as they are, and over counts that are blended.
fn pass<'s>(
    stage: &'s mut Stage<'_, '_>,
    resources: &FrameResources,
    blended: Option<wgpu::RenderPassColorAttachment<'_>>,
) -> wgpu::RenderPass<'s> {
    let as_it_is = wgpu::LoadOp::Load;
    let store = wgpu::StoreOp::Store;
    let colours: Vec<_> = blended.into_iter().map(Some).collect();
    let encoder = stage.encoder();
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("volumes"),
        color_attachments: &colours,
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &resources.targets.depth_view,
            depth_ops: Some(wgpu::Operations {
                load: as_it_is,
                store,
            }),
            stencil_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store,
            }),
        }),
        ..Default::default()
    })
}

/// Tests for a fragment shader that counts, from those for the stencil: it runs where the stencil would have counted.
fn count_in_shader(count: Count, tests: &mut wgpu::DepthStencilState) {
    use wgpu::CompareFunction::{Greater, GreaterEqual, Less, LessEqual};
    tests.stencil = wgpu::StencilState::default();
    if count == Count::DepthFails {
        tests.depth_compare = tests.depth_compare.map(|passes| match passes {
            Greater => LessEqual,
            Less => GreaterEqual,
            other => unreachable!("volumes are not tested with {other:?}"),
        });
    }
}

/// Front faces wind counter-clockwise. Counting wraps around; depth is never written.
fn depth_stencil(
    count: Count,
    format: wgpu::TextureFormat,
    parameters: &VolumeParameters,
) -> wgpu::DepthStencilState {
    let (front, back) = match count {
        Count::DepthPasses => (IncrementWrap, DecrementWrap),
        Count::DepthFails | Count::Everywhere => (DecrementWrap, IncrementWrap),
    };
    let face = |operation| {
        let keep = wgpu::StencilOperation::Keep;
        let (pass_op, depth_fail_op) = match count {
            Count::DepthFails => (keep, operation),
            Count::DepthPasses | Count::Everywhere => (operation, keep),
        };
        wgpu::StencilFaceState {
            // Always: the reference is 0. Where nothing asks for it, wgpu leaves it unset, and Vulkan wants it set.
            compare: wgpu::CompareFunction::LessEqual,
            fail_op: keep,
            pass_op,
            depth_fail_op,
        }
    };
    let push_back = parameters.push_back_px as f32;
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(false),
        depth_compare: Some(match count {
            Count::Everywhere => wgpu::CompareFunction::Always,
            Count::DepthFails | Count::DepthPasses => parameters.depth.nearer(),
        }),
        stencil: wgpu::StencilState {
            front: face(front),
            back: face(back),
            read_mask: 0xff,
            write_mask: 0xff,
        },
        bias: wgpu::DepthBiasState {
            constant: 0,
            slope_scale: match parameters.depth {
                DepthDirection::Reversed => -push_back,
                DepthDirection::Standard => push_back,
            },
            clamp: 0.0,
        },
    }
}
