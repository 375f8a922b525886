//! A compute shader that asks for each pixel whether it is in shadow.

use super::FrameResources;
use super::fullscreen::{bind_group, bind_group_layout};
use crate::gpu::Stage;

/// Pixels of a workgroup, along either side of the picture.
const GROUP_PX: u32 = 8;

/// What decides pixel by pixel what is in shadow.
pub struct PixelKernel<'a> {
    /// Includes shared/frame.wgsl and shared/pixels.wgsl.
    pub module: &'a wgpu::ShaderModule,
    /// Name of the shader, which works on 8 × 8 pixels.
    pub entry: &'a str,
    /// Values of the module's `override`s.
    pub constants: &'a [(&'a str, f64)],
    /// What it reads, at consecutive bindings of group 2.
    pub inputs: &'a [(wgpu::BindingType, wgpu::BindingResource<'a>)],
}

/// A compute pass over the picture that adds shadows to the mask.
pub struct PixelCompute {
    pipeline: wgpu::ComputePipeline,
    pixels: wgpu::BindGroup,
    inputs: wgpu::BindGroup,
}

impl PixelCompute {
    /// One for frames of these resources.
    pub fn new(
        device: &wgpu::Device,
        resources: &FrameResources,
        kernel: &PixelKernel<'_>,
    ) -> Self {
        let label = kernel.entry;
        let (types, inputs): (Vec<_>, Vec<_>) = kernel.inputs.iter().cloned().unzip();
        let compute = wgpu::ShaderStages::COMPUTE;
        let input_layout = bind_group_layout(device, label, compute, &types);
        let pixel_buffers = &resources.targets.pixels;
        let (pixel_layout, pixels) = pixel_buffers.for_compute(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[
                Some(&resources.uniform.layout),
                Some(&pixel_layout),
                Some(&input_layout),
            ],
            ..Default::default()
        });
        let constants = [kernel.constants, &pixel_buffers.constants()].concat();
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: Some(&layout),
            module: kernel.module,
            entry_point: Some(kernel.entry),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &constants,
                ..Default::default()
            },
            cache: None,
        });
        Self {
            pipeline,
            pixels,
            inputs: bind_group(device, &input_layout, &inputs),
        }
    }

    /// Runs it.
    pub fn record(&self, stage: &mut Stage<'_, '_>, resources: &FrameResources) {
        let targets = &resources.targets;
        let encoder = stage.encoder();
        targets.pixels.take_mask(encoder, &targets.mask);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &resources.uniform.bind_group, &[]);
        pass.set_bind_group(1, &self.pixels, &[]);
        pass.set_bind_group(2, &self.inputs, &[]);
        let groups = |px: u32| px.div_ceil(GROUP_PX);
        pass.dispatch_workgroups(groups(targets.width), groups(targets.height), 1);
        drop(pass);
        targets.pixels.give_mask(encoder, &targets.mask);
    }
}
