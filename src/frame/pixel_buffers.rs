//! What passes over the picture tell each other about its pixels.

use super::fullscreen::{bind_group, bind_group_layout, buffer_binding};
use crate::gpu::{DeviceError, Gpu};

/// Rows of a picture begin at multiples of so many pixels: a copy from a texture asks for it.
const ROW_ALIGNMENT: u32 = 256;

/// Pictures in buffers. Where the device is a processor, reading a texture takes ten times as long, and copies of whole
/// pictures next to nothing.
pub(super) struct PixelBuffers {
    /// Pixels from one row to the next.
    row_px: u32,
    /// A copy of [`triangle_ids`](super::Targets::triangle_ids).
    triangle_ids: wgpu::Buffer,
    /// A copy of [`mask`](super::Targets::mask).
    mask: wgpu::Buffer,
    /// See pixel.wgsl.
    surfaces: wgpu::Buffer,
    /// Depth beside edges, where it is to be moved: see visible_triangles.wgsl.
    moved_depths: wgpu::Buffer,
}

impl PixelBuffers {
    /// For pictures of `width` × `height` pixels.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub(super) fn new(gpu: &Gpu, width: u32, height: u32) -> Result<Self, DeviceError> {
        let row_px = row_px(width);
        let buffer = |what, bytes_per_px: u64| {
            let bytes = bytes_per_px * u64::from(row_px) * u64::from(height);
            let copied = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
            let usage = wgpu::BufferUsages::STORAGE | copied;
            gpu.empty_buffer(what, bytes, usage)
        };
        Ok(Self {
            row_px,
            triangle_ids: buffer("the triangle numbers of a picture", 4)?,
            mask: buffer("a copy of the shadow mask", 1)?,
            surfaces: buffer("the surfaces of a picture", 4)?,
            moved_depths: buffer("the moved depths of a picture", 4)?,
        })
    }

    /// The constant of shared/pixel.wgsl.
    pub(super) fn constants(&self) -> [(&'static str, f64); 1] {
        [("row_px", f64::from(self.row_px))]
    }

    /// Pixels from one row to the next.
    pub(super) fn row_px(&self) -> u32 {
        self.row_px
    }

    /// Copies the triangle numbers that were drawn.
    pub(super) fn take_triangle_ids(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        drawn: &wgpu::Texture,
    ) {
        copy(encoder, drawn, &self.triangle_ids, 4);
    }

    /// Copies the shadow mask as it is.
    pub(super) fn take_mask(&self, encoder: &mut wgpu::CommandEncoder, mask: &wgpu::Texture) {
        copy(encoder, mask, &self.mask, 1);
    }

    /// Brings the copy back.
    pub(super) fn give_mask(&self, encoder: &mut wgpu::CommandEncoder, mask: &wgpu::Texture) {
        let from = of_rows(&self.mask, mask, 1);
        encoder.copy_buffer_to_texture(from, mask.as_image_copy(), mask.size());
    }

    /// Triangle numbers to be read, the mask to be changed.
    pub(super) fn for_compute(
        &self,
        device: &wgpu::Device,
    ) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
        let stage = wgpu::ShaderStages::COMPUTE;
        bound(
            device,
            stage,
            [true, false],
            [&self.triangle_ids, &self.mask],
        )
    }

    /// Triangle numbers to be read, surfaces and moved depths to be written.
    pub(super) fn for_visible_triangles(
        &self,
        device: &wgpu::Device,
    ) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
        let buffers = [&self.triangle_ids, &self.surfaces, &self.moved_depths];
        bound(device, FRAGMENT, [true, false, false], buffers)
    }

    /// Surfaces and moved depths to be read.
    pub(super) fn for_edge_depth(
        &self,
        device: &wgpu::Device,
    ) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
        bound(
            device,
            FRAGMENT,
            [true; 2],
            [&self.surfaces, &self.moved_depths],
        )
    }

    /// The mask and surfaces to be read.
    pub(super) fn for_shade(
        &self,
        device: &wgpu::Device,
    ) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
        bound(device, FRAGMENT, [true; 2], [&self.mask, &self.surfaces])
    }
}

/// Pixels from one row of a picture in a buffer to the next.
pub(super) fn row_px(width: u32) -> u32 {
    width.next_multiple_of(ROW_ALIGNMENT)
}

/// Copies a picture into a buffer.
pub(super) fn copy(
    encoder: &mut wgpu::CommandEncoder,
    from: &wgpu::Texture,
    to: &wgpu::Buffer,
    bytes_per_px: u32,
) {
    let to = of_rows(to, from, bytes_per_px);
    encoder.copy_texture_to_buffer(from.as_image_copy(), to, from.size());
}

/// A buffer that holds a picture of a texture's size.
fn of_rows<'a>(
    buffer: &'a wgpu::Buffer,
    texture: &wgpu::Texture,
    bytes_per_px: u32,
) -> wgpu::TexelCopyBufferInfo<'a> {
    wgpu::TexelCopyBufferInfo {
        buffer,
        layout: wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(bytes_per_px * row_px(texture.width())),
            rows_per_image: None,
        },
    }
}

const FRAGMENT: wgpu::ShaderStages = wgpu::ShaderStages::FRAGMENT;

fn bound<const N: usize>(
    device: &wgpu::Device,
    stages: wgpu::ShaderStages,
    read_only: [bool; N],
    buffers: [&wgpu::Buffer; N],
) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let storage = |read_only| buffer_binding(wgpu::BufferBindingType::Storage { read_only });
    let types = read_only.map(storage);
    let layout = bind_group_layout(device, "pixels", stages, &types);
    let resources = buffers.map(wgpu::Buffer::as_entire_binding);
    let group = bind_group(device, &layout, &resources);
    (layout, group)
}
