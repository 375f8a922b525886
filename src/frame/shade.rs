//! The last stage: the lit picture.

use super::Targets;
use super::fullscreen::{self, FullscreenDesc};
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
        let (input_layout, inputs) = targets.pixels.for_shade(device);
        let module = shader::wgsl(device, "frame/shade.wgsl");
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shade"),
            bind_group_layouts: &[Some(&input_layout)],
            ..Default::default()
        });
        let desc = FullscreenDesc {
            constants: &targets.pixels.constants(),
            ..FullscreenDesc::new(&module, "shade", &layout, COLOUR_FORMAT)
        };
        Self {
            pipeline: fullscreen::pipeline(device, &desc),
            inputs,
        }
    }

    pub(super) fn record(&self, encoder: &mut wgpu::CommandEncoder, targets: &Targets) {
        targets.pixels.take_mask(encoder, &targets.mask);
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let mut pass = fullscreen::pass(encoder, "shade", &targets.colour_view, load, None);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.inputs, &[]);
        pass.draw(0..3, 0..1);
    }
}
