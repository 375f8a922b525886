//! A pass over the picture that adds shadows to the mask.

use super::FrameResources;
use super::fullscreen::{self, FullscreenDesc, bind_group, bind_group_layout};
use super::targets::MASK_FORMAT;
use crate::gpu::Stage;

/// Keeps the larger of what is there and what is drawn: what is dark already stays so.
const MAX_BLEND: wgpu::BlendState = {
    let component = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Max,
    };
    wgpu::BlendState {
        color: component,
        alpha: component,
    }
};

/// What decides pixel by pixel how much of it is in shadow.
pub struct MaskShader<'a> {
    /// Includes shared/frame.wgsl and shared/fullscreen.wgsl.
    pub module: &'a wgpu::ShaderModule,
    /// Name of the fragment shader; it gives 0 for lit to 1 for in shadow.
    pub fragment: &'a str,
    /// Values of the module's `override`s.
    pub constants: &'a [(&'a str, f64)],
    /// What it reads, at consecutive bindings of group 1.
    pub inputs: &'a [(wgpu::BindingType, wgpu::BindingResource<'a>)],
}

/// A pass over the picture that adds shadows to the mask.
pub struct MaskPass {
    pipeline: wgpu::RenderPipeline,
    inputs: wgpu::BindGroup,
}

impl MaskPass {
    /// One for frames of these resources.
    pub fn new(device: &wgpu::Device, resources: &FrameResources, shader: &MaskShader<'_>) -> Self {
        let label = shader.fragment;
        let (types, inputs): (Vec<_>, Vec<_>) = shader.inputs.iter().cloned().unzip();
        let fragment = wgpu::ShaderStages::FRAGMENT;
        let input_layout = bind_group_layout(device, label, fragment, &types);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[Some(&resources.uniform.layout), Some(&input_layout)],
            ..Default::default()
        });
        let desc = FullscreenDesc {
            constants: shader.constants,
            blend: Some(MAX_BLEND),
            ..FullscreenDesc::new(shader.module, label, &layout, MASK_FORMAT)
        };
        Self {
            pipeline: fullscreen::pipeline(device, &desc),
            inputs: bind_group(device, &input_layout, &inputs),
        }
    }

    /// Draws it.
    pub fn record(&self, stage: &mut Stage<'_, '_>, resources: &FrameResources) {
        let mask = &resources.targets.mask_view;
        let load = wgpu::LoadOp::Load;
        let mut pass = fullscreen::pass(stage.encoder(), "mask", mask, load, None);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &resources.uniform.bind_group, &[]);
        pass.set_bind_group(1, &self.inputs, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        stage.count_draws(1);
    }
}
