//! Passes over the picture that ask which triangle is visible: what of the mask, of depth and of shading follows from it.

use super::fullscreen::{self, FullscreenDesc};
use super::targets::MASK_FORMAT;
use super::{FrameUniform, SceneBuffers, Targets};
use crate::gpu::{Gpu, shader};

/// The last part of the G-buffer stage: the shadow mask that every method starts from, with the sides that face
/// away from the light, the depth of lit sides beside their own edges, and what shading needs (see the shaders).
pub struct VisibleTriangles {
    visible: wgpu::RenderPipeline,
    pixels: wgpu::BindGroup,
    edge_depth: wgpu::RenderPipeline,
    moved_depth: wgpu::BindGroup,
}

impl VisibleTriangles {
    pub(super) fn new(
        gpu: &Gpu,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        targets: &Targets,
    ) -> Self {
        let device = &gpu.device;
        let constants = &targets.pixels.constants();
        let pipeline_layout = |label, groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(label),
                bind_group_layouts: groups,
                ..Default::default()
            })
        };
        let (pixels_layout, pixels) = targets.pixels.for_visible_triangles(device);
        let layouts = [
            Some(&uniform.layout),
            Some(&scene.layout),
            Some(&pixels_layout),
        ];
        let layout = pipeline_layout("visible triangles", &layouts);
        let module = shader::wgsl(device, "frame/visible_triangles.wgsl");
        let visible = FullscreenDesc {
            constants,
            ..FullscreenDesc::new(&module, "visible_triangles", &layout, MASK_FORMAT)
        };
        let visible = fullscreen::pipeline(device, &visible);

        let (moved_layout, moved_depth) = targets.pixels.for_edge_depth(device);
        let layout = pipeline_layout("edge depth", &[Some(&moved_layout)]);
        let module = shader::wgsl(device, "frame/edge_depth.wgsl");
        let edge_depth = FullscreenDesc {
            formats: Vec::new(),
            constants,
            depth_stencil: Some(wgpu::DepthStencilState {
                format: targets.depth.format(),
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            ..FullscreenDesc::new(&module, "edge_depth", &layout, MASK_FORMAT)
        };
        Self {
            visible,
            pixels,
            edge_depth: fullscreen::pipeline(device, &edge_depth),
            moved_depth,
        }
    }

    /// Records both passes; returns how many draw calls that is.
    pub(super) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        targets: &Targets,
    ) -> u32 {
        targets
            .pixels
            .take_triangle_ids(encoder, &targets.triangle_ids);
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let view = &targets.mask_view;
        let mut pass = fullscreen::pass(encoder, "visible triangles", view, load, None);
        pass.set_pipeline(&self.visible);
        pass.set_bind_group(0, &uniform.bind_group, &[]);
        pass.set_bind_group(1, &scene.bind_group, &[]);
        pass.set_bind_group(2, &self.pixels, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        let mut pass = depth_pass(encoder, targets);
        pass.set_pipeline(&self.edge_depth);
        pass.set_bind_group(0, &self.moved_depth, &[]);
        pass.draw(0..3, 0..1);
        2
    }
}

/// A pass that writes depth alone.
fn depth_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    targets: &Targets,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("edge depth"),
        color_attachments: &[],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth_view,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}
