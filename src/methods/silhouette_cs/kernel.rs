//! A compute shader with the buffers that it reads and writes.

use crate::gpu::Gpu;

/// Invocations of a workgroup, where there is more than one.
const WORKGROUP: u32 = 64;

/// An entry point with all that it is bound to.
pub(super) struct Kernel {
    pipeline: wgpu::ComputePipeline,
    groups: Vec<(u32, wgpu::BindGroup)>,
    workgroups: u32,
}

/// Buffers and where they are bound.
pub(super) type Bindings<'a> = &'a [(u32, &'a wgpu::Buffer)];

/// What a kernel is made of.
pub(super) struct KernelDesc<'a> {
    pub(super) module: &'a wgpu::ShaderModule,
    pub(super) entry_point: &'a str,
    pub(super) constants: &'a [(&'a str, f64)],
    /// Bindings of group 0, if there are any.
    pub(super) uniforms: Bindings<'a>,
    /// Bindings of group 1.
    pub(super) buffers: Bindings<'a>,
}

impl Kernel {
    /// A kernel of at least so many invocations.
    pub(super) fn new(gpu: &Gpu, desc: &KernelDesc<'_>, invocations: u32) -> Self {
        let device = &gpu.device;
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(desc.entry_point),
            layout: None,
            module: desc.module,
            entry_point: Some(desc.entry_point),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: desc.constants,
                ..Default::default()
            },
            cache: None,
        });
        let group = |number, buffers: Bindings<'_>| {
            let entries: Vec<_> = buffers
                .iter()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(desc.entry_point),
                layout: &pipeline.get_bind_group_layout(number),
                entries: &entries,
            });
            (number, group)
        };
        let bound = [(0, desc.uniforms), (1, desc.buffers)].into_iter();
        let bound = bound.filter(|(_, buffers)| !buffers.is_empty());
        Self {
            groups: bound
                .map(|(number, buffers)| group(number, buffers))
                .collect(),
            pipeline,
            workgroups: invocations.div_ceil(WORKGROUP),
        }
    }

    pub(super) fn dispatch(&self, pass: &mut wgpu::ComputePass<'_>) {
        self.set(pass);
        pass.dispatch_workgroups(self.workgroups, 1, 1);
    }

    /// With so many workgroups as a buffer says, instead of its own.
    pub(super) fn dispatch_indirect(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        workgroups: &wgpu::Buffer,
    ) {
        self.set(pass);
        pass.dispatch_workgroups_indirect(workgroups, 0);
    }

    fn set(&self, pass: &mut wgpu::ComputePass<'_>) {
        pass.set_pipeline(&self.pipeline);
        for (number, group) in &self.groups {
            pass.set_bind_group(*number, group, &[]);
        }
    }
}
