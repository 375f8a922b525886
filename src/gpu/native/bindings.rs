//! The buffers that native shaders read.

use super::{NativeError, raw_device, wait_idle};
use ash::vk;
use wgpu::hal::api::Vulkan;

/// How a shader sees a buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BindingKind {
    /// `uniform` block, std140.
    Uniform,
    /// `buffer` block, std430.
    Storage,
}

/// Room for [`NativePass::set_constants`](super::NativePass::set_constants).
pub(super) const DRAW_CONSTANTS_BYTES: u32 = 16;

/// Descriptor set 0: buffers at bindings 0, 1, 2, ... in the order given; and constants of four `u32`.
pub struct Bindings {
    pub(super) layout: vk::PipelineLayout,
    pub(super) set: vk::DescriptorSet,
    set_layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    raw: ash::Device,
    device: wgpu::Device,
    _buffers: Vec<wgpu::Buffer>,
}

impl Bindings {
    /// Binds whole buffers, visible to every stage.
    ///
    /// # Errors
    /// When the device does not run on Vulkan or is out of memory.
    pub fn new(
        device: &wgpu::Device,
        buffers: &[(BindingKind, &wgpu::Buffer)],
    ) -> Result<Self, NativeError> {
        let raw = raw_device(device)?;
        let made = Self::unbound(raw, device, buffers)?;
        for (binding, (kind, buffer)) in (0..).zip(buffers) {
            // SAFETY: the clones kept in `_buffers` outlive every use of the descriptor set.
            unsafe {
                let handle = buffer
                    .as_hal::<Vulkan>()
                    .ok_or(NativeError::NotVulkan)?
                    .raw_handle();
                let infos = [vk::DescriptorBufferInfo {
                    buffer: handle,
                    offset: 0,
                    range: vk::WHOLE_SIZE,
                }];
                let write = vk::WriteDescriptorSet::default()
                    .dst_set(made.set)
                    .dst_binding(binding)
                    .descriptor_type(descriptor_type(*kind))
                    .buffer_info(&infos);
                made.raw.update_descriptor_sets(&[write], &[]);
            }
        }
        Ok(made)
    }

    /// The set with its layout, before it has any buffer.
    fn unbound(
        raw: ash::Device,
        device: &wgpu::Device,
        buffers: &[(BindingKind, &wgpu::Buffer)],
    ) -> Result<Self, NativeError> {
        let slots: Vec<_> = (0..)
            .zip(buffers)
            .map(|(binding, (kind, _))| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(binding)
                    .descriptor_count(1)
                    .descriptor_type(descriptor_type(*kind))
                    .stage_flags(vk::ShaderStageFlags::ALL)
            })
            .collect();
        let size = |(kind, _): &(BindingKind, _)| vk::DescriptorPoolSize {
            ty: descriptor_type(*kind),
            descriptor_count: 1,
        };
        let sizes: Vec<_> = buffers.iter().map(size).collect();
        let layout_info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&slots);
        let pool_info = vk::DescriptorPoolCreateInfo::default()
            .max_sets(1)
            .pool_sizes(&sizes);
        let constants = [draw_constants()];
        // SAFETY: the create infos point to arrays that live until after the calls, and every
        // handle passed was made by the same device in a call before.
        let (set_layout, pool, layout, set) = unsafe {
            let set_layout = raw.create_descriptor_set_layout(&layout_info, None)?;
            let pool = raw.create_descriptor_pool(&pool_info, None)?;
            let set_layouts = [set_layout];
            let layout = raw.create_pipeline_layout(
                &vk::PipelineLayoutCreateInfo::default()
                    .set_layouts(&set_layouts)
                    .push_constant_ranges(&constants),
                None,
            )?;
            let sets = raw.allocate_descriptor_sets(
                &vk::DescriptorSetAllocateInfo::default()
                    .descriptor_pool(pool)
                    .set_layouts(&set_layouts),
            )?;
            (set_layout, pool, layout, sets[0])
        };
        let _buffers = buffers
            .iter()
            .map(|(_, buffer)| (*buffer).clone())
            .collect();
        Ok(Self {
            layout,
            set,
            set_layout,
            pool,
            raw,
            device: device.clone(),
            _buffers,
        })
    }
}

impl Drop for Bindings {
    fn drop(&mut self) {
        wait_idle(&self.device);
        // SAFETY: nothing that was submitted still runs, and these handles are ours alone.
        unsafe {
            self.raw.destroy_pipeline_layout(self.layout, None);
            self.raw.destroy_descriptor_pool(self.pool, None);
            self.raw
                .destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

fn draw_constants() -> vk::PushConstantRange {
    vk::PushConstantRange::default()
        .stage_flags(vk::ShaderStageFlags::ALL)
        .size(DRAW_CONSTANTS_BYTES)
}

fn descriptor_type(kind: BindingKind) -> vk::DescriptorType {
    match kind {
        BindingKind::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
        BindingKind::Storage => vk::DescriptorType::STORAGE_BUFFER,
    }
}
