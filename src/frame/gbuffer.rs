//! The first stage: depth and triangle ids of everything, a draw call per object.

use super::hidden_objects::{HiddenObjects, ObjectLook};
use super::numbered::NumberedVertices;
use super::occlusion::DepthBuffer;
use super::targets::TRIANGLE_ID_FORMAT;
use super::{DepthSetup, FrameView, SceneBuffers, SceneExtents, Targets, Visibility};
use crate::gpu::{Gpu, Stage, shader};
use std::cell::RefCell;

/// Pipeline of the G-buffer stage.
pub struct GBuffer {
    pipeline: wgpu::RenderPipeline,
    far: f32,
    /// Where what is hidden is not drawn.
    hidden: Option<RefCell<HiddenObjects>>,
}

impl GBuffer {
    pub(super) fn new(
        gpu: &Gpu,
        buffer: &DepthBuffer<'_>,
        scene: &SceneBuffers,
        (depth, extents): (DepthSetup, &SceneExtents),
    ) -> Self {
        let module = shader::wgsl(&gpu.device, "frame/gbuffer.wgsl");
        let layout = gpu
            .device
            .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("gbuffer"),
                bind_group_layouts: &[Some(&buffer.uniform.layout), Some(&scene.layout)],
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
            hidden: (depth.visibility == Visibility::Occlusion)
                .then(|| RefCell::new(HiddenObjects::new(gpu, buffer, extents))),
        }
    }

    /// The next frame does not follow the one before.
    pub(super) fn begin(&self) {
        if let Some(hidden) = &self.hidden {
            hidden.borrow_mut().forget();
        }
    }

    pub(super) fn record(
        &self,
        stage: &mut Stage<'_, '_>,
        depth: &DepthBuffer<'_>,
        scene: &SceneBuffers,
        (view, extents): (&FrameView, &SceneExtents),
    ) -> anyhow::Result<()> {
        let draw = |stage: &mut Stage<'_, '_>, is_first: bool, mut objects: Vec<u32>| {
            // Of surfaces with equal depth the first is seen, so the order is that of the scene.
            objects.sort_unstable();
            let mut pass = self.pass(stage.encoder(), depth.targets, is_first);
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &depth.uniform.bind_group, &[]);
            pass.set_bind_group(1, &scene.bind_group, &[]);
            let objects = objects
                .iter()
                .map(|object| &scene.objects[*object as usize]);
            let draw_calls = scene.numbered.draw(&mut pass, objects);
            drop(pass);
            stage.count_draws(draw_calls);
        };
        if let Some(hidden) = &self.hidden {
            let look = ObjectLook::new(view, extents, depth.targets.height);
            return hidden.borrow_mut().draw(stage, depth, &look, draw);
        }
        let objects = (0..).zip(&extents.objects);
        let in_view = objects.filter(|(_, bounds)| view.may_see(**bounds));
        draw(stage, true, in_view.map(|(object, _)| object).collect());
        Ok(())
    }

    fn pass<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        targets: &Targets,
        is_first: bool,
    ) -> wgpu::RenderPass<'a> {
        let stencil = targets.depth.format().has_stencil_aspect();
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("gbuffer"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &targets.triangle_ids_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: first(is_first, wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth_view,
                depth_ops: Some(wgpu::Operations {
                    load: first(is_first, self.far),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: stencil.then_some(wgpu::Operations {
                    load: first(is_first, 0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            ..Default::default()
        })
    }
}

/// Clears before the first draws of a frame.
fn first<T: Default>(is_first: bool, clear: T) -> wgpu::LoadOp<T> {
    match is_first {
        true => wgpu::LoadOp::Clear(clear),
        false => wgpu::LoadOp::Load,
    }
}
