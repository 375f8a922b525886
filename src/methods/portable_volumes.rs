//! Shadow volumes whose faces are lists of corners, counted by wgpu's own passes: no native stage.

use super::counter::Counts;
use super::volume_parameters::VolumeParameters;
use super::{MethodError, PrepareContext};
use crate::frame::FrameResources;
use crate::geometry::EndPlane;
use crate::gpu::{DepthDirection, Stage, shader};
use crate::scene::Mesh;
use std::ops::Range;
use wgpu::StencilOperation::{DecrementWrap, IncrementWrap};

/// Bits of a corner's number that are the vertex; those above are 0 at the vertex itself, and at the far end of its shadow 1
/// and more, the end plane.
const VERTEX_BITS: u32 = 29;

/// The number of the corner at a vertex.
pub(super) const fn near(vertex: u32) -> u32 {
    vertex
}

/// The number of the corner at the far end of a vertex's shadow.
pub(super) fn far(vertex: u32, end: EndPlane) -> u32 {
    vertex | (end.index() as u32 + 1) << VERTEX_BITS
}

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
        }
    }
}

/// The pipelines.
pub(super) struct PortableVolumes {
    depth_passes: wgpu::RenderPipeline,
    depth_fails: wgpu::RenderPipeline,
    everywhere: wgpu::RenderPipeline,
    pub(super) counts: Counts,
}

impl PortableVolumes {
    pub(super) fn new(
        context: &PrepareContext<'_>,
        parameters: &VolumeParameters,
    ) -> Result<Self, MethodError> {
        let PrepareContext { gpu, resources, .. } = context;
        check(&context.scene.mesh)?;
        let device = &gpu.device;
        let module = shader::wgsl(device, "methods/volumes/corner.wgsl");
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("volumes"),
            bind_group_layouts: &[
                Some(&resources.uniform.layout),
                Some(&resources.scene.layout),
            ],
            ..Default::default()
        });
        let counts = Counts::new(context, parameters.counter, parameters.depth_setup())?;
        let target = counts.target();
        let depth_format = resources.targets.depth.format();
        let pipeline = |count| {
            let mut tests = depth_stencil(count, depth_format, parameters);
            if target.is_some() {
                count_in_shader(count, &mut tests);
            }
            pipeline(device, (&module, &layout), count, tests, target.as_ref())
        };
        Ok(Self {
            depth_passes: pipeline(Count::DepthPasses),
            depth_fails: pipeline(Count::DepthFails),
            everywhere: pipeline(Count::Everywhere),
            counts,
        })
    }

    /// Counts the faces whose corners are in `elements`, but for those of open edges.
    pub(super) fn record(
        &self,
        stage: &mut Stage<'_, '_>,
        resources: &FrameResources,
        elements: &wgpu::Buffer,
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
        elements: &wgpu::Buffer,
        corners: &Corners,
    ) {
        let draws = [(&self.depth_passes, &corners.of_open_edges)];
        self.draw(stage, resources, elements, &draws);
    }

    fn draw(
        &self,
        stage: &mut Stage<'_, '_>,
        resources: &FrameResources,
        elements: &wgpu::Buffer,
        draws: &[(&wgpu::RenderPipeline, &FaceDraws)],
    ) {
        let mut pass = pass(stage, resources, self.counts.attachment());
        pass.set_bind_group(0, &resources.uniform.bind_group, &[]);
        pass.set_bind_group(1, &resources.scene.bind_group, &[]);
        pass.set_index_buffer(elements.slice(..), wgpu::IndexFormat::Uint32);
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

/// A pipeline that counts faces: in the stencil by its tests, or in a target by a fragment shader.
fn pipeline(
    device: &wgpu::Device,
    (module, layout): (&wgpu::ShaderModule, &wgpu::PipelineLayout),
    count: Count,
    tests: wgpu::DepthStencilState,
    target: Option<&wgpu::ColorTargetState>,
) -> wgpu::RenderPipeline {
    let targets = [target.cloned()];
    let constants = [("seen_from_outside", count.of_front_face())];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("volumes"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("corner"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(tests),
        multisample: wgpu::MultisampleState::default(),
        fragment: target.map(|_| wgpu::FragmentState {
            module,
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

/// Whether corners have numbers for all vertices.
fn check(mesh: &Mesh) -> Result<(), MethodError> {
    let vertices = mesh.positions.len();
    if vertices > 1 << VERTEX_BITS {
        let message = format!(
            "{vertices} vertices are more than the {} that it can number",
            1 << VERTEX_BITS
        );
        return Err(MethodError::Unavailable(message));
    }
    Ok(())
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
