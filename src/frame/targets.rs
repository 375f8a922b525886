//! The textures that a frame is drawn into.

use super::DepthSetup;
use super::pixel_buffers::PixelBuffers;
use crate::gpu::{DeviceError, Gpu};

/// All targets of a frame, of one size.
pub struct Targets {
    /// Picture width.
    pub width: u32,
    /// Picture height.
    pub height: u32,
    /// Depth, and the stencil counter where the device has one.
    pub depth: wgpu::Texture,
    /// The whole of `depth`, as an attachment.
    pub depth_view: wgpu::TextureView,
    /// The depth aspect alone, for sampling.
    pub depth_only_view: wgpu::TextureView,
    /// `R32Uint`: number of the visible triangle plus 1, or 0.
    pub triangle_ids: wgpu::Texture,
    /// View of `triangle_ids`.
    pub triangle_ids_view: wgpu::TextureView,
    /// `R8Unorm`: 0 lit or background, 1 in shadow.
    pub mask: wgpu::Texture,
    /// View of `mask`.
    pub mask_view: wgpu::TextureView,
    /// `Rgba8Unorm`: the lit picture, gamma-encoded.
    pub colour: wgpu::Texture,
    /// View of `colour`.
    pub colour_view: wgpu::TextureView,
    pub(super) pixels: PixelBuffers,
}

/// Format of [`Targets::triangle_ids`].
pub const TRIANGLE_ID_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Uint;
/// Format of [`Targets::mask`].
pub const MASK_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;
/// Format of [`Targets::colour`].
pub const COLOUR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Targets {
    /// Targets of `width` × `height` pixels.
    ///
    /// # Errors
    /// When the device cannot hold them.
    pub fn new(gpu: &Gpu, width: u32, height: u32, depth: DepthSetup) -> Result<Self, DeviceError> {
        let desc = |label, format, usage| wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
            view_formats: &[],
        };
        let texture = |label, format, usage| gpu.texture(&desc(label, format, usage));
        let read = wgpu::TextureUsages::COPY_SRC;
        let sample = wgpu::TextureUsages::TEXTURE_BINDING;
        let of_depth = desc("a depth buffer", depth.texture_format(gpu), read | sample);
        let depth = match depth.stencil_in_shaders {
            true => gpu.depth_stencil_input(&of_depth)?,
            false => gpu.texture(&of_depth)?,
        };
        let triangle_ids = texture(
            "a picture of triangle numbers",
            TRIANGLE_ID_FORMAT,
            read | sample,
        )?;
        let write = wgpu::TextureUsages::COPY_DST;
        let mask = texture("a shadow mask", MASK_FORMAT, read | sample | write)?;
        let colour = texture("a picture", COLOUR_FORMAT, read)?;
        let view = |texture: &wgpu::Texture, aspect| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                aspect,
                ..Default::default()
            })
        };
        Ok(Self {
            width,
            height,
            depth_view: view(&depth, wgpu::TextureAspect::All),
            depth_only_view: view(&depth, wgpu::TextureAspect::DepthOnly),
            triangle_ids_view: view(&triangle_ids, wgpu::TextureAspect::All),
            mask_view: view(&mask, wgpu::TextureAspect::All),
            colour_view: view(&colour, wgpu::TextureAspect::All),
            pixels: PixelBuffers::new(gpu, width, height)?,
            depth,
            triangle_ids,
            mask,
            colour,
        })
    }

    /// Replaces the shadow mask, for a picture with shadows that no method drew.
    pub fn write_mask(&self, gpu: &Gpu, mask: &[u8]) {
        gpu.queue.write_texture(
            self.mask.as_image_copy(),
            mask,
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(self.width),
                rows_per_image: None,
            },
            self.mask.size(),
        );
    }
}
