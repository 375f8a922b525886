//! Vertex and element buffers of native draws, and draws whose numbers are on the device.

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
        Ok(Self {
            vertices: raw_buffer(vertices)?,
            indices: raw_buffer(indices)?,
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

/// Draws whose numbers a compute pass or an upload has written: for each the four `u32` vertex count, instance
/// count, first vertex and first instance; or the five of which an indexed draw has index count, instance count, first index,
/// a number added to all, and first instance.
pub struct IndirectDraws {
    pub(super) buffer: vk::Buffer,
    pub(super) count: u32,
    pub(super) stride: u64,
    device: wgpu::Device,
    _buffer: wgpu::Buffer,
}

impl IndirectDraws {
    /// Bytes of the numbers of one draw.
    pub const STRIDE: u64 = 16;

    /// The same of an indexed draw.
    pub const INDEXED_STRIDE: u64 = 20;

    /// As many as `buffer`, which must have the usage `INDIRECT`, has room for.
    ///
    /// # Errors
    /// When the device does not run on Vulkan.
    pub fn new(device: &wgpu::Device, buffer: &wgpu::Buffer) -> Result<Self, NativeError> {
        Self::with_stride(device, buffer, Self::STRIDE)
    }

    /// The same of places with room for the numbers of an indexed draw; of another, the last is left out.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn indexed(device: &wgpu::Device, buffer: &wgpu::Buffer) -> Result<Self, NativeError> {
        Self::with_stride(device, buffer, Self::INDEXED_STRIDE)
    }

    fn with_stride(
        device: &wgpu::Device,
        buffer: &wgpu::Buffer,
        stride: u64,
    ) -> Result<Self, NativeError> {
        assert!(buffer.usage().contains(wgpu::BufferUsages::INDIRECT));
        Ok(Self {
            buffer: raw_buffer(buffer)?,
            count: (buffer.size() / stride) as u32,
            stride,
            device: device.clone(),
            _buffer: buffer.clone(),
        })
    }
}

impl Drop for IndirectDraws {
    /// As for [`IndexedGeometry`].
    fn drop(&mut self) {
        wait_idle(&self.device);
    }
}

/// The handle of a buffer, which whoever uses it must keep alive.
fn raw_buffer(buffer: &wgpu::Buffer) -> Result<vk::Buffer, NativeError> {
    // SAFETY: the handle is only borrowed; callers keep a clone of `buffer`.
    unsafe {
        let hal = buffer.as_hal::<Vulkan>().ok_or(NativeError::NotVulkan)?;
        Ok(hal.raw_handle())
    }
}
