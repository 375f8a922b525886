//! Shadow volumes whose faces are lists of corners, counted in the stencil buffer by wgpu's own passes: no native stage.
//!
//! Corners are numbered: twice the vertex, and one more for the far end of its shadow.

use super::PrepareContext;
use super::volume_parameters::{Reach, VolumeParameters};
use crate::frame::{FrameResources, StencilResolve};
use crate::gpu::{DepthDirection, Stage, shader};
use std::ops::Range;
use wgpu::StencilOperation::{DecrementWrap, IncrementWrap};

/// The number of the corner at a vertex.
pub(super) const fn near(vertex: u32) -> u32 {
    2 * vertex
}

/// The number of the corner at the far end of a vertex's shadow.
pub(super) const fn far(vertex: u32) -> u32 {
    2 * vertex + 1
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

/// Which corners of an element buffer are the faces of each way of counting: three corners a triangle, counter-clockwise
/// seen from outside of the volume.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Corners {
    pub(super) depth_passes: Range<u32>,
    pub(super) depth_fails: Range<u32>,
    pub(super) everywhere: Range<u32>,
}

/// The pipelines.
pub(super) struct PortableVolumes {
    depth_passes: wgpu::RenderPipeline,
    depth_fails: wgpu::RenderPipeline,
    everywhere: wgpu::RenderPipeline,
    pub(super) resolve: StencilResolve,
}

impl PortableVolumes {
    pub(super) fn new(context: &PrepareContext<'_>, parameters: &VolumeParameters) -> Self {
        let PrepareContext { gpu, resources, .. } = context;
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
        let reach_infinity = f64::from(u8::from(parameters.reach == Reach::Infinity));
        let pipeline = |count| {
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("volumes"),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("corner"),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &[("reach_infinity", reach_infinity)],
                        ..Default::default()
                    },
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: Some(depth_stencil(
                    count,
                    resources.targets.depth.format(),
                    parameters,
                )),
                multisample: wgpu::MultisampleState::default(),
                fragment: None,
                multiview_mask: None,
                cache: None,
            })
        };
        Self {
            depth_passes: pipeline(Count::DepthPasses),
            depth_fails: pipeline(Count::DepthFails),
            everywhere: pipeline(Count::Everywhere),
            resolve: StencilResolve::new(gpu, parameters.depth_setup()),
        }
    }

    /// Counts the faces whose corners are in `elements`.
    pub(super) fn record(
        &self,
        stage: &mut Stage<'_, '_>,
        resources: &FrameResources,
        elements: &wgpu::Buffer,
        corners: &Corners,
    ) {
        let mut pass = stage
            .encoder()
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("volumes"),
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &resources.targets.depth_view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Load,
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Load,
                        store: wgpu::StoreOp::Store,
                    }),
                }),
                ..Default::default()
            });
        pass.set_bind_group(0, &resources.uniform.bind_group, &[]);
        pass.set_bind_group(1, &resources.scene.bind_group, &[]);
        pass.set_index_buffer(elements.slice(..), wgpu::IndexFormat::Uint32);
        let draws = [
            (&self.depth_passes, &corners.depth_passes),
            (&self.depth_fails, &corners.depth_fails),
            (&self.everywhere, &corners.everywhere),
        ];
        pass.set_stencil_reference(0);
        let mut draw_calls = 0;
        for (pipeline, corners) in draws {
            if !corners.is_empty() {
                pass.set_pipeline(pipeline);
                pass.draw_indexed(corners.clone(), 0, 0..1);
                draw_calls += 1;
            }
        }
        drop(pass);
        stage.count_draws(draw_calls);
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
