//! Buffers and textures, held against the device's limits and memory before they are made.

use super::fault::DeviceError;
use super::{Gpu, native};
use crate::memory::{self, size_text};

/// Below this, memory is not asked about: asking takes longer than making.
const SMALL_BYTES: u64 = 16 << 20;

impl Gpu {
    /// A buffer with `contents`; an empty one gets a few bytes nobody reads, for Vulkan has none.
    ///
    /// # Errors
    /// When the device cannot hold or bind so much.
    pub fn buffer(
        &self,
        label: &str,
        contents: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, DeviceError> {
        self.new_buffer(label, contents.len() as u64, usage, Some(contents))
    }

    /// A buffer of at least so many bytes, which are 0.
    ///
    /// # Errors
    /// When the device cannot hold or bind so much.
    pub fn empty_buffer(
        &self,
        label: &str,
        bytes: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, DeviceError> {
        self.new_buffer(label, bytes, usage, None)
    }

    fn new_buffer(
        &self,
        label: &str,
        bytes: u64,
        usage: wgpu::BufferUsages,
        contents: Option<&[u8]>,
    ) -> Result<wgpu::Buffer, DeviceError> {
        let size = bytes.max(16);
        let size = size.next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
        self.check_buffer(label, size, usage)?;
        self.attempt(|| {
            let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage,
                mapped_at_creation: contents.is_some(),
            });
            if let Some(contents) = contents {
                // Where there is no range, the device has told why.
                if let Ok(mut range) = buffer.get_mapped_range_mut(..) {
                    range.slice(..contents.len()).copy_from_slice(contents);
                }
                buffer.unmap();
            }
            Ok(buffer)
        })
    }

    /// Whether the device can hold a buffer, and bind it whole.
    ///
    /// # Errors
    /// When it cannot.
    pub fn check_buffer(
        &self,
        label: &str,
        size: u64,
        usage: wgpu::BufferUsages,
    ) -> Result<(), DeviceError> {
        let limits = self.device.limits();
        let mut most = limits.max_buffer_size;
        if usage.contains(wgpu::BufferUsages::STORAGE) {
            most = most.min(limits.max_storage_buffer_binding_size);
        }
        if usage.contains(wgpu::BufferUsages::UNIFORM) {
            most = most.min(limits.max_uniform_buffer_binding_size);
        }
        if size > most {
            let (size, most) = (size_text(size), size_text(most));
            return Err(DeviceError::TooLarge(format!(
                "{label} take {size}, and a buffer of this device holds {most} for shaders"
            )));
        }
        self.check_memory(label, size)
    }

    /// A texture.
    ///
    /// # Errors
    /// When the device cannot hold it.
    pub fn texture(
        &self,
        desc: &wgpu::TextureDescriptor<'_>,
    ) -> Result<wgpu::Texture, DeviceError> {
        self.check_texture(desc)?;
        self.attempt(|| Ok(self.device.create_texture(desc)))
    }

    /// A depth-stencil texture that fragment shaders of native passes can read while it is drawn into.
    ///
    /// # Errors
    /// When the device cannot hold it.
    pub fn depth_stencil_input(
        &self,
        desc: &wgpu::TextureDescriptor<'_>,
    ) -> Result<wgpu::Texture, DeviceError> {
        self.check_texture(desc)?;
        self.attempt(|| Ok(native::depth_stencil_input(&self.device, desc)?))
    }

    /// Whether a texture is not too large, and there is memory for it.
    fn check_texture(&self, desc: &wgpu::TextureDescriptor<'_>) -> Result<(), DeviceError> {
        let limits = self.device.limits();
        let (side, layers) = (
            limits.max_texture_dimension_2d,
            limits.max_texture_array_layers,
        );
        let wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers,
        } = desc.size;
        let name = format!(
            "{} of {width} × {height}",
            desc.label.unwrap_or("a texture")
        );
        if width.max(height) > side || depth_or_array_layers > layers {
            return Err(DeviceError::TooLarge(format!(
                "{name} is larger than this device allows ({side} × {side})"
            )));
        }
        let bytes = texture_bytes(desc);
        let most = self.memory.most_at_once;
        if bytes > most {
            let (bytes, most) = (size_text(bytes), size_text(most));
            return Err(DeviceError::TooLarge(format!(
                "{name} takes {bytes}, and this device gives {most} at once"
            )));
        }
        self.check_memory(&name, bytes)
    }

    /// Whether there is memory for `bytes` more, beside what was made already.
    ///
    /// # Errors
    /// When there is not.
    pub fn check_memory(&self, label: &str, bytes: u64) -> Result<(), DeviceError> {
        if bytes < SMALL_BYTES {
            return Ok(());
        }
        let free = |available: u64| {
            memory::check_against(bytes, available)
                .map_err(|error| DeviceError::TooLarge(format!("{label} {error}")))
        };
        if let Some(heap) = native::free_heap_bytes(&self.device) {
            free(heap)?;
        }
        if !self.is_software() {
            return Ok(());
        }
        // What was made but not drawn into yet takes no memory so far.
        let made = self.device.generate_allocator_report();
        let made = made.map_or(0, |report| report.total_allocated_bytes);
        let at_opening = self
            .memory
            .host_at_opening
            .map(|at| at.saturating_sub(made));
        let now = memory::available_bytes();
        [at_opening, now]
            .into_iter()
            .flatten()
            .min()
            .map_or(Ok(()), free)
    }
}

fn texture_bytes(desc: &wgpu::TextureDescriptor<'_>) -> u64 {
    let texel = match desc.format {
        wgpu::TextureFormat::Depth32FloatStencil8 => 8,
        wgpu::TextureFormat::Depth24PlusStencil8 => 4,
        format => u64::from(format.block_copy_size(None).unwrap_or(4)),
    };
    let wgpu::Extent3d {
        width,
        height,
        depth_or_array_layers,
    } = desc.size;
    texel * u64::from(width) * u64::from(height) * u64::from(depth_or_array_layers)
}
