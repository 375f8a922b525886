//! The first stage: depth and triangle ids of everything, a draw call per object.

use super::numbered::NumberedVertices;
use super::targets::TRIANGLE_ID_FORMAT;
use super::{DepthSetup, FrameUniform, FrameView, SceneBuffers, SceneExtents, Targets};
use crate::gpu::{Gpu, shader};

/// Pipeline of the G-buffer stage.
pub struct GBuffer {
    pipeline: wgpu::RenderPipeline,
    far: f32,
}

impl GBuffer {
    pub(super) fn new(
        gpu: &Gpu,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        depth: DepthSetup,
    ) -> Self {
        let module = shader::wgsl(&gpu.device, "frame/gbuffer.wgsl");
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("gbuffer"),
                bind_group_layouts: &[Some(&uniform.layout), Some(&scene.layout)],
                ..Default::default()
            });
        let pipeline = gpu
            .device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("gbuffer"),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vertex"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[Some(NumberedVertices::layout())],
                },
                // Both sides of every surface are drawn: open meshes show their backs, and a front cap
                // on the far plane is exact only if its caster is in the depth buffer.
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: depth.texture_format(gpu),
                    depth_write_enabled: Some(true),
                    depth_compare: Some(depth.direction.nearer()),
                    stencil: wgpu::StencilState::default(),
                    bias: wgpu::DepthBiasState::default(),
                }),
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("fragment"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(TRIANGLE_ID_FORMAT.into())],
                }),
                multiview_mask: None,
                cache: None,
            });
        Self {
            pipeline,
            far: depth.direction.far(),
        }
    }

    pub(super) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        targets: &Targets,
        (view, extents): (&FrameView, &SceneExtents),
    ) -> u32 {
        let mut pass = self.pass(encoder, targets);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &uniform.bind_group, &[]);
        pass.set_bind_group(1, &scene.bind_group, &[]);
        let boxes = extents.objects.iter();
        let objects = scene.objects.iter().zip(boxes);
        let in_view = objects.filter(|(_, bounds)| view.may_see(**bounds));
        scene
            .numbered
            .draw(&mut pass, in_view.map(|(object, _)| object))
    }

    fn pass<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        targets: &Targets,
    ) -> wgpu::RenderPass<'a> {
        let stencil = targets.depth.format().has_stencil_aspect();
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("gbuffer"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &targets.triangle_ids_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth_view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(self.far),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: stencil.then_some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            ..Default::default()
        })
    }
}
