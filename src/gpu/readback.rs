//! Reading textures back to the CPU. Never used in a frame that is measured: it waits.

use super::Gpu;

/// The texels of mip level 0 of a 2D texture, rows from the top, tightly packed.
///
/// # Errors
/// When the device is lost.
pub fn read_texture(gpu: &Gpu, texture: &wgpu::Texture) -> anyhow::Result<Vec<u8>> {
    gpu.attempt(|| read_aspect(gpu, texture, wgpu::TextureAspect::All))
}

/// The stencil counts of a depth-stencil texture, one byte a pixel, rows from the top.
///
/// # Errors
/// When the device is lost.
pub fn read_stencil(gpu: &Gpu, texture: &wgpu::Texture) -> anyhow::Result<Vec<u8>> {
    gpu.attempt(|| read_aspect(gpu, texture, wgpu::TextureAspect::StencilOnly))
}

/// How the rows of a 2D texture lie in a buffer that the device copies to or from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rows {
    /// Bytes of the texels of a row.
    pub(super) row_bytes: u32,
    /// Bytes from one row to the next.
    pub(super) pitch_bytes: u32,
    rows: u32,
}

impl Rows {
    pub(super) fn of(texture: &wgpu::Texture, aspect: wgpu::TextureAspect) -> anyhow::Result<Self> {
        let texel_bytes = texture
            .format()
            .block_copy_size(Some(aspect))
            .ok_or_else(|| anyhow::anyhow!("{:?} cannot be copied", texture.format()))?;
        let row_bytes = texture.width() * texel_bytes;
        Ok(Self {
            row_bytes,
            pitch_bytes: row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT),
            rows: texture.height(),
        })
    }

    /// Bytes of all rows in the buffer.
    pub(super) fn bytes(self) -> u64 {
        u64::from(self.pitch_bytes) * u64::from(self.rows)
    }

    /// Bytes of all texels.
    pub(super) fn tight_bytes(self) -> u64 {
        u64::from(self.row_bytes) * u64::from(self.rows)
    }

    /// Their layout from `offset` on.
    pub(super) fn layout(self, offset: u64) -> wgpu::TexelCopyBufferLayout {
        wgpu::TexelCopyBufferLayout {
            offset,
            bytes_per_row: Some(self.pitch_bytes),
            rows_per_image: None,
        }
    }

    /// The texels of the buffer's `bytes`, tightly packed.
    pub(super) fn pack(self, bytes: &[u8]) -> Vec<u8> {
        let rows = bytes.chunks_exact(self.pitch_bytes as usize);
        let mut texels = Vec::with_capacity(self.tight_bytes() as usize);
        rows.for_each(|row| texels.extend_from_slice(&row[..self.row_bytes as usize]));
        texels
    }
}

fn read_aspect(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    aspect: wgpu::TextureAspect,
) -> anyhow::Result<Vec<u8>> {
    let rows = Rows::of(texture, aspect)?;
    let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
    gpu.check_buffer("the pixels read back", rows.bytes(), usage)?;
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size: rows.bytes(),
        usage,
        mapped_at_creation: false,
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_texture_to_buffer(
        wgpu::TexelCopyTextureInfo {
            aspect,
            ..texture.as_image_copy()
        },
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: rows.layout(0),
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    Ok(rows.pack(&read_buffer(gpu, &buffer)?))
}

/// The contents of a buffer with `MAP_READ` usage, after all submitted work is done.
///
/// # Errors
/// When the device is lost.
pub fn read_buffer(gpu: &Gpu, buffer: &wgpu::Buffer) -> anyhow::Result<Vec<u8>> {
    gpu.attempt(|| map(gpu, buffer))
}

fn map(gpu: &Gpu, buffer: &wgpu::Buffer) -> anyhow::Result<Vec<u8>> {
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver lives until the end of this function.
        let _ = sender.send(result);
    });
    gpu.poll(wgpu::PollType::wait_indefinitely())?;
    receiver.try_recv()??;
    let bytes = buffer.get_mapped_range(..)?.to_vec();
    buffer.unmap();
    Ok(bytes)
}
