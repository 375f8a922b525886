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

fn read_aspect(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    aspect: wgpu::TextureAspect,
) -> anyhow::Result<Vec<u8>> {
    let texel_bytes = texture
        .format()
        .block_copy_size(Some(aspect))
        .ok_or_else(|| anyhow::anyhow!("{:?} cannot be read back", texture.format()))?;
    let (width, height) = (texture.width(), texture.height());
    let row_bytes = width * texel_bytes;
    let padded_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let size = u64::from(padded_row_bytes) * u64::from(height);
    let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
    gpu.check_buffer("the pixels read back", size, usage)?;
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size,
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
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded_row_bytes),
                rows_per_image: None,
            },
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    let bytes = read_buffer(gpu, &buffer)?;
    let rows = bytes.chunks_exact(padded_row_bytes as usize);
    Ok(rows
        .flat_map(|row| &row[..row_bytes as usize])
        .copied()
        .collect())
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
