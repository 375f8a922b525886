//! The last stage: the lit picture.

use super::Targets;
use super::fullscreen::{self, FullscreenDesc, bind_group, bind_group_layout, texture_binding};
use super::targets::COLOUR_FORMAT;
use crate::gpu::{Gpu, shader};

/// Pipeline and bindings of the shading stage.
pub struct Shade {
    pipeline: wgpu::RenderPipeline,
    inputs: wgpu::BindGroup,
}

impl Shade {
    pub(super) fn new(gpu: &Gpu, targets: &Targets) -> Self {
        let device = &gpu.device;
        let plain = texture_binding(wgpu::TextureSampleType::Float { filterable: false });
        let types = [texture_binding(wgpu::TextureSampleType::Uint), plain, plain];
        let stages = wgpu::ShaderStages::FRAGMENT;
        let input_layout = bind_group_layout(device, "shade inputs", stages, &types);
        let views = [
            &targets.triangle_ids_view,
            &targets.mask_view,
            &targets.shading_view,
        ];
        let views = views.map(wgpu::BindingResource::TextureView);
        let module = shader::wgsl(device, "frame/shade.wgsl");
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shade"),
            bind_group_layouts: &[Some(&input_layout)],
            ..Default::default()
        });
        let desc = FullscreenDesc::new(&module, "shade", &layout, COLOUR_FORMAT);
        Self {
            pipeline: fullscreen::pipeline(device, &desc),
            inputs: bind_group(device, &input_layout, &views),
        }
    }

    pub(super) fn record(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) {
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let mut pass = fullscreen::pass(encoder, "shade", &targets.colour_view, load, None);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.inputs, &[]);
        pass.draw(0..3, 0..1);
    }
}
