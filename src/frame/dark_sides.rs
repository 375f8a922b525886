//! The shadow mask that every method starts from: surfaces that face away from the light.

use super::fullscreen::{self, FullscreenDesc, bind_group, bind_group_layout, texture_binding};
use super::targets::MASK_FORMAT;
use super::{FrameUniform, SceneBuffers, Targets};
use crate::gpu::{Gpu, shader};

/// Pipeline and bindings, part of the G-buffer stage.
pub struct DarkSides {
    pipeline: wgpu::RenderPipeline,
    inputs: wgpu::BindGroup,
}

impl DarkSides {
    pub(super) fn new(
        gpu: &Gpu,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        targets: &Targets,
    ) -> Self {
        let device = &gpu.device;
        let ids = [texture_binding(wgpu::TextureSampleType::Uint)];
        let input_layout = bind_group_layout(
            device,
            "dark sides inputs",
            wgpu::ShaderStages::FRAGMENT,
            &ids,
        );
        let ids = wgpu::BindingResource::TextureView(&targets.triangle_ids_view);
        let inputs = bind_group(device, &input_layout, &[ids]);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("dark sides"),
            bind_group_layouts: &[
                Some(&uniform.layout),
                Some(&scene.layout),
                Some(&input_layout),
            ],
            ..Default::default()
        });
        let module = shader::wgsl(device, "frame/dark_sides.wgsl");
        let desc = FullscreenDesc::new(&module, "dark_sides", &layout, MASK_FORMAT);
        let pipeline = fullscreen::pipeline(device, &desc);
        Self { pipeline, inputs }
    }

    pub(super) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        targets: &Targets,
    ) {
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let mut pass = fullscreen::pass(encoder, "dark sides", &targets.mask_view, load, None);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &uniform.bind_group, &[]);
        pass.set_bind_group(1, &scene.bind_group, &[]);
        pass.set_bind_group(2, &self.inputs, &[]);
        pass.draw(0..3, 0..1);
    }
}
