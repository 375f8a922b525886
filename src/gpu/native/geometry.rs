//! Vertex and element buffers of native draws.

use super::{NativeError, wait_idle};
use ash::vk;
use wgpu::hal::api::Vulkan;

/// A vertex buffer and an element buffer of 32-bit indices into it.
pub struct IndexedGeometry {
    pub(super) vertices: vk::Buffer,
    pub(super) indices: vk::Buffer,
    device: wgpu::Device,
    _buffers: [wgpu::Buffer; 2],
}

impl IndexedGeometry {
    /// Wraps `vertices`, which must have the usage `VERTEX`, and `indices`, with the usage `INDEX`.
    ///
    /// # Errors
    /// When the device does not run on Vulkan.
    pub fn new(
        device: &wgpu::Device,
        vertices: &wgpu::Buffer,
        indices: &wgpu::Buffer,
    ) -> Result<Self, NativeError> {
        assert!(vertices.usage().contains(wgpu::BufferUsages::VERTEX));
        assert!(indices.usage().contains(wgpu::BufferUsages::INDEX));
        let handle = |buffer: &wgpu::Buffer| {
            // SAFETY: the handle is borrowed; the clones in `_buffers` keep the buffer alive.
            unsafe {
                let hal = buffer.as_hal::<Vulkan>().ok_or(NativeError::NotVulkan)?;
                Ok::<_, NativeError>(hal.raw_handle())
            }
        };
        Ok(Self {
            vertices: handle(vertices)?,
            indices: handle(indices)?,
            device: device.clone(),
            _buffers: [vertices.clone(), indices.clone()],
        })
    }
}

impl Drop for IndexedGeometry {
    /// wgpu does not see that native draws read the buffers, so it must not free them earlier.
    fn drop(&mut self) {
        wait_idle(&self.device);
    }
}
