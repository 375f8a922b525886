//! Parts of work that one kernel leaves to the next, which has a workgroup for each: so that a large triangle keeps more than
//! one invocation busy.

use super::PrepareContext;
use crate::frame::{FrameResources, PixelCompute, PixelKernel, write};
use crate::gpu::DeviceError;
use wgpu::BufferUsages as Usage;

/// How many there is room for; what finds none is done by the kernel that would have left it, which takes longer.
const ROOM: u64 = 1 << 21;
/// Bytes before them: twin of `HEADER` in parts.wgsl.
const HEADER_BYTES: u64 = 16;

/// The parts of a frame.
pub(super) struct Parts {
    /// See shaders/shared/parts.wgsl.
    pub(super) buffer: wgpu::Buffer,
}

/// What does them.
pub(super) struct PartKernel {
    kernel: PixelCompute,
    workgroups: wgpu::Buffer,
    spread: PixelCompute,
}

impl Parts {
    /// None.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub(super) fn new(context: &PrepareContext<'_>) -> Result<Self, DeviceError> {
        let bytes = HEADER_BYTES + 8 * ROOM;
        let usage = Usage::STORAGE | Usage::COPY_DST;
        let buffer = context.gpu.empty_buffer("parts of work", bytes, usage)?;
        Ok(Self { buffer })
    }

    /// Forgets those of the last frame.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.clear_buffer(&self.buffer, 0, Some(HEADER_BYTES));
    }

    /// A kernel that does a part in each of its workgroups.
    ///
    /// # Errors
    /// When the device has no memory left.
    pub(super) fn kernel(
        &self,
        context: &PrepareContext<'_>,
        kernel: PixelCompute,
    ) -> Result<PartKernel, DeviceError> {
        let PrepareContext { gpu, resources, .. } = *context;
        let usage = Usage::STORAGE | Usage::INDIRECT;
        let workgroups = gpu.empty_buffer("workgroups of parts", 16, usage)?;
        let spread = PixelKernel {
            path: "shared/spread.wgsl",
            constants: &[],
            inputs: &[write(&self.buffer), write(&workgroups)],
        };
        Ok(PartKernel {
            kernel,
            spread: PixelCompute::new(gpu, resources, &spread),
            workgroups,
        })
    }
}

impl PartKernel {
    /// Does what was left.
    pub(super) fn record(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.spread.times(pass, resources, 1);
        self.kernel.indirect(pass, resources, &self.workgroups);
    }
}
