//! What a picture shows at each pixel whose light is in question, for methods that hold triangles against points.

use super::PrepareContext;
use crate::frame::{FrameResources, PixelCompute, PixelKernel, read, write};
use crate::gpu::DeviceError;

/// Bytes of each of the structs in shaders/shared/view_sample.wgsl.
const BYTES: u64 = 16;

/// Most storage buffers that a shader of the methods with samples has: cast_clusters.wgsl.
const STORAGE_BUFFERS: u32 = 11;

/// The samples of a picture, and what takes them.
pub(super) struct ViewSamples {
    /// Of each pixel, as pixels are in buffers, a corner of the triangle that it shows.
    pub(super) corners: wgpu::Buffer,
    /// The way from there to the point, and a word that a method may use.
    pub(super) ways: wgpu::Buffer,
    /// The point of each, and a word that a method may use.
    pub(super) points: wgpu::Buffer,
    /// How many.
    pub(super) count: u32,
    take: PixelCompute,
}

/// The constant `scene_rounding` of the methods' shaders: what one subtraction may round by, twice over, where a triangle is as
/// large as the scene.
pub(super) fn scene_rounding(context: &PrepareContext<'_>) -> (&'static str, f64) {
    let bounds = context.resources.extents.scene;
    let size = (bounds.high - bounds.low).max_element();
    ("scene_rounding", size / f64::from(1 << 22))
}

impl ViewSamples {
    /// For pictures of the context's size.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub(super) fn new(context: &PrepareContext<'_>) -> Result<Self, DeviceError> {
        let PrepareContext { gpu, resources, .. } = *context;
        let most = gpu.device.limits().max_storage_buffers_per_shader_stage;
        if most < STORAGE_BUFFERS {
            return Err(DeviceError::TooLarge(format!(
                "a shader of this method reads and writes {STORAGE_BUFFERS} buffers, and one of this device {most} at most"
            )));
        }
        let count = resources.buffer_px();
        let usage = wgpu::BufferUsages::STORAGE;
        let of_each = |what| gpu.empty_buffer(what, BYTES * u64::from(count), usage);
        let corners = of_each("samples of a picture")?;
        let ways = of_each("samples of a picture")?;
        let points = of_each("points of a picture")?;
        let scene = &resources.scene;
        let kernel = PixelKernel {
            path: "shared/take_samples.wgsl",
            constants: &[],
            inputs: &[
                read(&scene.positions),
                read(&scene.indices),
                write(&corners),
                write(&ways),
                write(&points),
            ],
        };
        Ok(Self {
            take: PixelCompute::new(gpu, resources, &kernel),
            corners,
            ways,
            points,
            count,
        })
    }

    /// Takes them, after the mask was.
    pub(super) fn record(&self, pass: &mut wgpu::ComputePass<'_>, resources: &FrameResources) {
        self.take.for_pixels(pass, resources);
    }
}
