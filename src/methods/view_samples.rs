//! What a picture shows at each pixel whose light is in question, for methods that hold triangles against points.

use super::PrepareContext;
use crate::frame::{FrameResources, PixelCompute, PixelKernel, read, write};
use crate::gpu::DeviceError;

/// Bytes of a `ViewSample` in shaders/shared/view_sample.wgsl.
const SAMPLE_BYTES: u64 = 32;
/// Bytes of its point.
const POINT_BYTES: u64 = 16;

/// The samples of a picture, and what takes them.
pub(super) struct ViewSamples {
    /// One a pixel, as pixels are in buffers.
    pub(super) buffer: wgpu::Buffer,
    /// The point of each, and a word that a method may use.
    pub(super) points: wgpu::Buffer,
    /// How many.
    pub(super) count: u32,
    take: PixelCompute,
}

impl ViewSamples {
    /// For pictures of the context's size.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub(super) fn new(context: &PrepareContext<'_>) -> Result<Self, DeviceError> {
        let PrepareContext { gpu, resources, .. } = *context;
        let count = resources.buffer_px();
        let usage = wgpu::BufferUsages::STORAGE;
        let of_each = |what, bytes| gpu.empty_buffer(what, bytes * u64::from(count), usage);
        let buffer = of_each("samples of a picture", SAMPLE_BYTES)?;
        let points = of_each("points of a picture", POINT_BYTES)?;
        let scene = &resources.scene;
        let kernel = PixelKernel {
            path: "shared/take_samples.wgsl",
            constants: &[],
            inputs: &[
                read(&scene.positions),
                read(&scene.indices),
                write(&buffer),
                write(&points),
            ],
        };
        Ok(Self {
            take: PixelCompute::new(gpu, resources, &kernel),
            buffer,
            points,
            count,
        })
    }

    /// Takes them, after the mask was.
    pub(super) fn record(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.take.for_pixels(pass, resources);
    }
}
