//! Parts of triangles that one kernel leaves to the next, which has a workgroup for each: so that a large triangle keeps more
//! than one invocation busy.

use super::PrepareContext;
use crate::frame::{FrameResources, PixelCompute, PixelKernel, write};
use crate::gpu::DeviceError;
use wgpu::BufferUsages as Usage;

/// How many there is room for; what finds none is done by the first kernel, which takes longer.
const ROOM: u64 = 1 << 21;

/// The parts of a frame.
pub(super) struct Parts {
    /// See shaders/shared/parts.wgsl.
    pub(super) buffer: wgpu::Buffer,
    workgroups: wgpu::Buffer,
    spread: PixelCompute,
}

impl Parts {
    /// None.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub(super) fn new(context: &PrepareContext<'_>) -> Result<Self, DeviceError> {
        let PrepareContext { gpu, resources, .. } = *context;
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let buffer = gpu.empty_buffer("parts of triangles", 8 + 8 * ROOM, usage)?;
        let usage = Usage::STORAGE | Usage::INDIRECT;
        let workgroups = gpu.empty_buffer("workgroups of parts", 16, usage)?;
        let kernel = PixelKernel {
            path: "shared/spread.wgsl",
            constants: &[],
            inputs: &[write(&buffer), write(&workgroups)],
        };
        Ok(Self {
            spread: PixelCompute::new(gpu, resources, &kernel),
            buffer,
            workgroups,
        })
    }

    /// Forgets those of the last frame.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.buffer, 0, Some(8));
    }

    /// Runs a kernel in a workgroup for each that was left.
    pub(super) fn run(
        &self,
        kernel: &PixelCompute,
        pass: &mut wgpu::ComputePass<'_>,
        resources: &FrameResources,
    ) {
        self.spread.times(pass, resources, 1);
        kernel.indirect(pass, resources, &self.workgroups);
    }
}
