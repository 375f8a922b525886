//! The last stage: the lit picture.

use super::fullscreen::{self, FullscreenDesc, bind_group, bind_group_layout, texture_binding};
use super::targets::COLOUR_FORMAT;
use super::{FrameUniform, SceneBuffers, Targets};
use crate::gpu::{Gpu, shader};

/// Pipeline and bindings of the shading stage.
pub struct Shade {
    pipeline: wgpu::RenderPipeline,
    geometry: wgpu::BindGroup,
    inputs: wgpu::BindGroup,
}

impl Shade {
    pub(super) fn new(
        gpu: &Gpu,
        uniform: &FrameUniform,
        scene: &SceneBuffers,
        targets: &Targets,
    ) -> Self {
        let device = &gpu.device;
        let input_layout = bind_group_layout(
            device,
            "shade inputs",
            wgpu::ShaderStages::FRAGMENT,
            &[
                texture_binding(wgpu::TextureSampleType::Uint),
                texture_binding(wgpu::TextureSampleType::Float { filterable: false }),
                texture_binding(wgpu::TextureSampleType::Depth),
            ],
        );
        let views = [
            &targets.triangle_ids_view,
            &targets.mask_view,
            &targets.depth_only_view,
        ];
        let inputs = bind_group(
            device,
            &input_layout,
            &views.map(wgpu::BindingResource::TextureView),
        );
        let module = shader::wgsl(device, "frame/shade.wgsl");
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shade"),
            bind_group_layouts: &[
                Some(&uniform.layout),
                Some(&scene.layout),
                Some(&input_layout),
            ],
            ..Default::default()
        });
        let desc = FullscreenDesc::new(&module, "shade", &layout, COLOUR_FORMAT);
        let pipeline = fullscreen::pipeline(device, &desc);
        Self {
            pipeline,
            geometry: scene.bind_group.clone(),
            inputs,
        }
    }

    pub(super) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        uniform: &FrameUniform,
        targets: &Targets,
    ) {
        let mut pass = fullscreen::pass(
            encoder,
            "shade",
            &targets.colour_view,
            wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
            None,
        );
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &uniform.bind_group, &[]);
        pass.set_bind_group(1, &self.geometry, &[]);
        pass.set_bind_group(2, &self.inputs, &[]);
        pass.draw(0..3, 0..1);
    }
}
