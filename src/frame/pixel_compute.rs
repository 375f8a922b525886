//! Compute shaders that know what each pixel shows and whether it is in shadow.

use super::FrameResources;
use super::fullscreen::{bind_group, bind_group_layout, buffer_binding};
use crate::gpu::{Gpu, Stage, shader};

/// Pixels of a workgroup, along either side of the picture.
const GROUP_PX: u32 = 8;
/// Invocations of a workgroup, however they are laid out.
const GROUP: u32 = GROUP_PX * GROUP_PX;
/// Workgroups in a row, at most; WebGPU guarantees so many.
const ROW: u32 = 65_535;

/// What such a shader is made of.
pub struct PixelKernel<'a> {
    /// Path of the shader, which includes shared/pixels.wgsl; its entry point has the name of its file.
    pub path: &'a str,
    /// Values of the module's `override`s.
    pub constants: &'a [(&'a str, f64)],
    /// What it reads and writes, at consecutive bindings of group 2.
    pub inputs: &'a [Input<'a>],
}

/// What a kernel reads or writes.
pub type Input<'a> = (wgpu::BindingType, wgpu::BindingResource<'a>);

/// A buffer that a kernel reads.
pub fn read(buffer: &wgpu::Buffer) -> Input<'_> {
    bound(buffer, true)
}

/// A buffer that a kernel writes.
pub fn write(buffer: &wgpu::Buffer) -> Input<'_> {
    bound(buffer, false)
}

fn bound(buffer: &wgpu::Buffer, read_only: bool) -> Input<'_> {
    let ty = wgpu::BufferBindingType::Storage { read_only };
    (buffer_binding(ty), buffer.as_entire_binding())
}

/// A compute shader with what it reads and writes.
pub struct PixelCompute {
    pipeline: wgpu::ComputePipeline,
    pixels: wgpu::BindGroup,
    inputs: wgpu::BindGroup,
}

impl PixelCompute {
    /// One for frames of these resources.
    pub fn new(gpu: &Gpu, resources: &FrameResources, kernel: &PixelKernel<'_>) -> Self {
        let device = &gpu.device;
        let name = kernel.path.rsplit('/').next().unwrap_or_default();
        let entry = name.trim_end_matches(".wgsl");
        let (types, inputs): (Vec<_>, Vec<_>) = kernel.inputs.iter().cloned().unzip();
        let compute = wgpu::ShaderStages::COMPUTE;
        let input_layout = bind_group_layout(device, entry, compute, &types);
        let pixel_buffers = &resources.targets.pixels;
        let (pixel_layout, pixels) = pixel_buffers.for_compute(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(entry),
            bind_group_layouts: &[
                Some(&resources.uniform.layout),
                Some(&pixel_layout),
                Some(&input_layout),
            ],
            ..Default::default()
        });
        let constants = [kernel.constants, &pixel_buffers.constants()].concat();
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: Some(&layout),
            module: &shader::wgsl(device, kernel.path),
            entry_point: Some(entry),
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

    /// Runs it for every pixel, as all that changes the mask.
    pub fn record(&self, stage: &mut Stage<'_, '_>, resources: &FrameResources) {
        let encoder = stage.encoder();
        resources.take_mask(encoder);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        self.for_pixels(&mut pass, resources);
        drop(pass);
        resources.give_mask(encoder);
    }

    /// Runs it for every pixel, of whose place it is told.
    pub fn for_pixels(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.set(pass, resources);
        let groups = |px: u32| px.div_ceil(GROUP_PX);
        let targets = &resources.targets;
        pass.dispatch_workgroups(groups(targets.width), groups(targets.height), 1);
    }

    /// Runs it at least `count` times: see `invocation` in shared/pixels.wgsl.
    pub fn times(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources, count: u32) {
        self.set(pass, resources);
        let groups = count.div_ceil(GROUP).max(1);
        let rows = groups.div_ceil(ROW);
        pass.dispatch_workgroups(groups.div_ceil(rows), rows, 1);
    }

    /// Runs it in so many workgroups as a buffer says.
    pub fn indirect(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        resources: &FrameResources,
        workgroups: &wgpu::Buffer,
    ) {
        self.set(pass, resources);
        pass.dispatch_workgroups_indirect(workgroups, 0);
    }

    fn set(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &resources.uniform.bind_group, &[]);
        pass.set_bind_group(1, &self.pixels, &[]);
        pass.set_bind_group(2, &self.inputs, &[]);
    }
}
