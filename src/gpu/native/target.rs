//! The attachments of a native render pass: the depth-stencil buffer, and counts that are blended.

use super::counting::CountIn;
use super::{NativeError, raw_device, wait_idle};
use crate::gpu::DepthDirection;
use ash::vk;
use wgpu::hal::api::Vulkan;

/// A wgpu depth-stencil texture that native passes draw into, and where they count.
pub struct Target {
    pub(in crate::gpu) depth: wgpu::Texture,
    pub(in crate::gpu) counts: CountIn,
    pub(super) render_pass: vk::RenderPass,
    pub(super) framebuffer: vk::Framebuffer,
    pub(super) extent: vk::Extent2D,
    pub(super) direction: DepthDirection,
    views: Vec<vk::ImageView>,
    raw: ash::Device,
    device: wgpu::Device,
}

/// The layout in which wgpu leaves a depth texture that a pass has written.
pub(super) const DEPTH_LAYOUT: vk::ImageLayout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

/// The layout of a depth texture that is written while fragment shaders read it.
pub(super) const INPUT_LAYOUT: vk::ImageLayout = vk::ImageLayout::GENERAL;

/// The same of a colour texture.
const COLOUR_LAYOUT: vk::ImageLayout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;

impl Target {
    /// Wraps `depth`, which must have the format `Depth32FloatStencil8`, or `Depth24PlusStencil8` on a device that has 24
    /// bits.
    ///
    /// # Errors
    /// When the device does not run on Vulkan or is out of memory.
    pub fn new(
        device: &wgpu::Device,
        depth: &wgpu::Texture,
        counts: CountIn,
        direction: DepthDirection,
    ) -> Result<Self, NativeError> {
        let raw = raw_device(device)?;
        let extent = vk::Extent2D {
            width: depth.width(),
            height: depth.height(),
        };
        let depth_aspects = vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL;
        let blended = counts.texture();
        let attached = std::iter::once((depth, depth_aspects))
            .chain(blended.map(|counts| (counts, vk::ImageAspectFlags::COLOR)));
        let views = attached.map(|(texture, aspects)| create_view(&raw, texture, aspects));
        let views: Vec<_> = views.collect::<Result<_, _>>()?;
        let render_pass = create_render_pass(&raw, depth, &counts)?;
        let framebuffer_info = vk::FramebufferCreateInfo::default()
            .render_pass(render_pass)
            .attachments(&views)
            .width(extent.width)
            .height(extent.height)
            .layers(1);
        // SAFETY: the render pass and the views were made just above by the same device.
        let framebuffer = unsafe { raw.create_framebuffer(&framebuffer_info, None) }?;
        Ok(Self {
            depth: depth.clone(),
            counts,
            render_pass,
            framebuffer,
            extent,
            direction,
            views,
            raw,
            device: device.clone(),
        })
    }
}

/// A format as wgpu takes it.
pub(super) fn format(format: wgpu::TextureFormat) -> vk::Format {
    match format {
        wgpu::TextureFormat::Depth32FloatStencil8 => vk::Format::D32_SFLOAT_S8_UINT,
        wgpu::TextureFormat::Depth24PlusStencil8 => vk::Format::D24_UNORM_S8_UINT,
        wgpu::TextureFormat::R16Float => vk::Format::R16_SFLOAT,
        wgpu::TextureFormat::R32Float => vk::Format::R32_SFLOAT,
        other => panic!("{other:?} is no format that native passes draw into"),
    }
}

pub(super) fn create_view(
    raw: &ash::Device,
    texture: &wgpu::Texture,
    aspects: vk::ImageAspectFlags,
) -> Result<vk::ImageView, NativeError> {
    // SAFETY: the handle is borrowed; whoever keeps the view keeps a clone of `texture`, and so the image alive.
    let image = unsafe {
        texture
            .as_hal::<Vulkan>()
            .ok_or(NativeError::NotVulkan)?
            .raw_handle()
    };
    let info = vk::ImageViewCreateInfo::default()
        .image(image)
        .view_type(vk::ImageViewType::TYPE_2D)
        .format(format(texture.format()))
        .subresource_range(vk::ImageSubresourceRange {
            aspect_mask: aspects,
            base_mip_level: 0,
            level_count: 1,
            base_array_layer: 0,
            layer_count: 1,
        });
    // SAFETY: `image` is alive and of this format.
    Ok(unsafe { raw.create_image_view(&info, None) }?)
}

/// Keeps what is in the attachments, and waits for the writes to them of whatever ran before; whatever runs after waits for
/// ours.
fn create_render_pass(
    raw: &ash::Device,
    depth: &wgpu::Texture,
    counts: &CountIn,
) -> Result<vk::RenderPass, vk::Result> {
    let blended = counts.texture();
    let attachment = |texture: &wgpu::Texture, layout| {
        vk::AttachmentDescription::default()
            .format(format(texture.format()))
            .samples(vk::SampleCountFlags::TYPE_1)
            .load_op(vk::AttachmentLoadOp::LOAD)
            .store_op(vk::AttachmentStoreOp::STORE)
            .stencil_load_op(vk::AttachmentLoadOp::LOAD)
            .stencil_store_op(vk::AttachmentStoreOp::STORE)
            .initial_layout(layout)
            .final_layout(layout)
    };
    let attachments: Vec<_> = std::iter::once(attachment(depth, DEPTH_LAYOUT))
        .chain(blended.map(|counts| attachment(counts, COLOUR_LAYOUT)))
        .collect();
    let of_depth = vk::AttachmentReference {
        attachment: 0,
        layout: match counts {
            CountIn::StencilInShaders => INPUT_LAYOUT,
            CountIn::Stencil | CountIn::Blended(_) => DEPTH_LAYOUT,
        },
    };
    let (inputs, flags) = match counts {
        CountIn::StencilInShaders => (
            std::slice::from_ref(&of_depth),
            vk::SubpassDescriptionFlags::RASTERIZATION_ORDER_ATTACHMENT_STENCIL_ACCESS_EXT,
        ),
        CountIn::Stencil | CountIn::Blended(_) => (&[][..], vk::SubpassDescriptionFlags::empty()),
    };
    let of_counts = blended.map(|_| vk::AttachmentReference {
        attachment: 1,
        layout: COLOUR_LAYOUT,
    });
    let subpasses = [vk::SubpassDescription::default()
        .flags(flags)
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .input_attachments(inputs)
        .color_attachments(of_counts.as_slice())
        .depth_stencil_attachment(&of_depth)];
    let dependencies = dependencies();
    let info = vk::RenderPassCreateInfo::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies);
    // SAFETY: all arrays that `info` points to live until after the call.
    unsafe { raw.create_render_pass(&info, None) }
}

/// On what ran before, and of what runs after.
fn dependencies() -> [vk::SubpassDependency; 2] {
    let stages = vk::PipelineStageFlags::EARLY_FRAGMENT_TESTS
        | vk::PipelineStageFlags::LATE_FRAGMENT_TESTS
        | vk::PipelineStageFlags::FRAGMENT_SHADER
        | vk::PipelineStageFlags::COLOR_ATTACHMENT_OUTPUT;
    let access = vk::AccessFlags::DEPTH_STENCIL_ATTACHMENT_READ
        | vk::AccessFlags::DEPTH_STENCIL_ATTACHMENT_WRITE
        | vk::AccessFlags::INPUT_ATTACHMENT_READ
        | vk::AccessFlags::COLOR_ATTACHMENT_READ
        | vk::AccessFlags::COLOR_ATTACHMENT_WRITE;
    let dependency = |source, destination| {
        vk::SubpassDependency::default()
            .src_subpass(source)
            .dst_subpass(destination)
            .src_stage_mask(stages)
            .dst_stage_mask(stages)
            .src_access_mask(access)
            .dst_access_mask(access)
    };
    [
        dependency(vk::SUBPASS_EXTERNAL, 0),
        dependency(0, vk::SUBPASS_EXTERNAL),
    ]
}

impl Drop for Target {
    fn drop(&mut self) {
        wait_idle(&self.device);
        // SAFETY: nothing that was submitted still runs, and these handles are ours alone.
        unsafe {
            self.raw.destroy_framebuffer(self.framebuffer, None);
            self.raw.destroy_render_pass(self.render_pass, None);
            for view in &self.views {
                self.raw.destroy_image_view(*view, None);
            }
        }
    }
}
