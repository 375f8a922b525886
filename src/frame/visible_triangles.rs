//! Passes over the picture that ask which triangle is visible: what of the mask and of depth follows from it.

use super::fullscreen::{self, FullscreenDesc, bind_group, bind_group_layout, texture_binding};
use super::targets::MASK_FORMAT;
use super::{FrameUniform, SceneBuffers, Targets};
use crate::gpu::{Gpu, shader};

/// The last part of the G-buffer stage: the shadow mask that every method starts from, with the sides that face
/// away from the light, and the depth of lit sides beside their own edges (see the two shaders).
pub struct VisibleTriangles {
    dark_sides: wgpu::RenderPipeline,
    edge_depth: wgpu::RenderPipeline,
    ids: wgpu::BindGroup,
}

impl VisibleTriangles {
    pub(super) fn new(
        gpu: &Gpu,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        targets: &Targets,
    ) -> Self {
        let device = &gpu.device;
        let types = [texture_binding(wgpu::TextureSampleType::Uint)];
        let ids_layout =
            bind_group_layout(device, "triangle ids", wgpu::ShaderStages::FRAGMENT, &types);
        let ids = wgpu::BindingResource::TextureView(&targets.triangle_ids_view);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("visible triangles"),
            bind_group_layouts: &[
                Some(&uniform.layout),
                Some(&scene.layout),
                Some(&ids_layout),
            ],
            ..Default::default()
        });
        let module = |path| shader::wgsl(device, path);
        let dark_sides = module("frame/dark_sides.wgsl");
        let dark_sides = FullscreenDesc::new(&dark_sides, "dark_sides", &layout, MASK_FORMAT);
        let edge_depth = module("frame/edge_depth.wgsl");
        let edge_depth = FullscreenDesc {
            format: None,
            depth_stencil: Some(wgpu::DepthStencilState {
                format: targets.depth.format(),
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            ..FullscreenDesc::new(&edge_depth, "edge_depth", &layout, MASK_FORMAT)
        };
        Self {
            dark_sides: fullscreen::pipeline(device, &dark_sides),
            edge_depth: fullscreen::pipeline(device, &edge_depth),
            ids: bind_group(device, &ids_layout, &[ids]),
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
        let draw = |mut pass: wgpu::RenderPass<'_>, pipeline| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &uniform.bind_group, &[]);
            pass.set_bind_group(1, &scene.bind_group, &[]);
            pass.set_bind_group(2, &self.ids, &[]);
            pass.draw(0..3, 0..1);
        };
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let pass = fullscreen::pass(encoder, "dark sides", &targets.mask_view, load, None);
        draw(pass, &self.dark_sides);
        draw(depth_pass(encoder, targets), &self.edge_depth);
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
