//! The depth-stencil buffer as the one attachment of a native render pass.

use super::{NativeError, raw_device, wait_idle};
use crate::gpu::DepthDirection;
use ash::vk;
use wgpu::hal::api::Vulkan;

/// A wgpu depth-stencil texture that native passes draw into.
pub struct Target {
    pub(in crate::gpu) texture: wgpu::Texture,
    pub(super) render_pass: vk::RenderPass,
    pub(super) framebuffer: vk::Framebuffer,
    pub(super) extent: vk::Extent2D,
    pub(super) direction: DepthDirection,
    view: vk::ImageView,
    raw: ash::Device,
    device: wgpu::Device,
}

/// The layout in which wgpu leaves a depth texture that a pass has written.
const LAYOUT: vk::ImageLayout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

impl Target {
    /// Wraps `texture`, which must have the format `Depth32FloatStencil8`, or `Depth24PlusStencil8` on
    /// a device that has 24 bits.
    ///
    /// # Errors
    /// When the device does not run on Vulkan or is out of memory.
    pub fn new(
        device: &wgpu::Device,
        texture: &wgpu::Texture,
        direction: DepthDirection,
    ) -> Result<Self, NativeError> {
        let format = match texture.format() {
            wgpu::TextureFormat::Depth32FloatStencil8 => vk::Format::D32_SFLOAT_S8_UINT,
            wgpu::TextureFormat::Depth24PlusStencil8 => vk::Format::D24_UNORM_S8_UINT,
            other => panic!("{other:?} is no depth-stencil format that native passes draw into"),
        };
        let raw = raw_device(device)?;
        let extent = vk::Extent2D {
            width: texture.width(),
            height: texture.height(),
        };
        // SAFETY: the handle is borrowed; the clone of `texture` below keeps the image alive.
        let image = unsafe {
            texture
                .as_hal::<Vulkan>()
                .ok_or(NativeError::NotVulkan)?
                .raw_handle()
        };
        let view_info = vk::ImageViewCreateInfo::default()
            .image(image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(format)
            .subresource_range(vk::ImageSubresourceRange {
                aspect_mask: vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL,
                base_mip_level: 0,
                level_count: 1,
                base_array_layer: 0,
                layer_count: 1,
            });
        // SAFETY: `image` is alive and of this format.
        let view = unsafe { raw.create_image_view(&view_info, None) }?;
        let render_pass = create_render_pass(&raw, format)?;
        let attachments = [view];
        let framebuffer_info = vk::FramebufferCreateInfo::default()
            .render_pass(render_pass)
            .attachments(&attachments)
            .width(extent.width)
            .height(extent.height)
            .layers(1);
        // SAFETY: the render pass and the view were made just above by the same device.
        let framebuffer = unsafe { raw.create_framebuffer(&framebuffer_info, None) }?;
        Ok(Self {
            texture: texture.clone(),
            render_pass,
            framebuffer,
            extent,
            direction,
            view,
            raw,
            device: device.clone(),
        })
    }
}

/// Keeps what is in the buffer, and waits for the depth and stencil writes of whatever ran before;
/// whatever runs after waits for ours.
fn create_render_pass(raw: &ash::Device, format: vk::Format) -> Result<vk::RenderPass, vk::Result> {
    let attachments = [vk::AttachmentDescription::default()
        .format(format)
        .samples(vk::SampleCountFlags::TYPE_1)
        .load_op(vk::AttachmentLoadOp::LOAD)
        .store_op(vk::AttachmentStoreOp::STORE)
        .stencil_load_op(vk::AttachmentLoadOp::LOAD)
        .stencil_store_op(vk::AttachmentStoreOp::STORE)
        .initial_layout(LAYOUT)
        .final_layout(LAYOUT)];
    let reference = vk::AttachmentReference {
        attachment: 0,
        layout: LAYOUT,
    };
    let subpasses = [vk::SubpassDescription::default()
        .pipeline_bind_point(vk::PipelineBindPoint::GRAPHICS)
        .depth_stencil_attachment(&reference)];
    let stages =
        vk::PipelineStageFlags::EARLY_FRAGMENT_TESTS | vk::PipelineStageFlags::LATE_FRAGMENT_TESTS;
    let access = vk::AccessFlags::DEPTH_STENCIL_ATTACHMENT_READ
        | vk::AccessFlags::DEPTH_STENCIL_ATTACHMENT_WRITE;
    let dependency = |source, destination| {
        vk::SubpassDependency::default()
            .src_subpass(source)
            .dst_subpass(destination)
            .src_stage_mask(stages)
            .dst_stage_mask(stages)
            .src_access_mask(access)
            .dst_access_mask(access)
    };
    let dependencies = [
        dependency(vk::SUBPASS_EXTERNAL, 0),
        dependency(0, vk::SUBPASS_EXTERNAL),
    ];
    let info = vk::RenderPassCreateInfo::default()
        .attachments(&attachments)
        .subpasses(&subpasses)
        .dependencies(&dependencies);
    // SAFETY: all arrays that `info` points to live until after the call.
    unsafe { raw.create_render_pass(&info, None) }
}

impl Drop for Target {
    fn drop(&mut self) {
        wait_idle(&self.device);
        // SAFETY: nothing that was submitted still runs, and these handles are ours alone.
        unsafe {
            self.raw.destroy_framebuffer(self.framebuffer, None);
            self.raw.destroy_render_pass(self.render_pass, None);
            self.raw.destroy_image_view(self.view, None);
        }
    }
}
