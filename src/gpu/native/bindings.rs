//! The buffers that native shaders read.

use super::counting::CountIn;
use super::target::{INPUT_LAYOUT, Target, create_view};
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

/// Room for [`NativePass::set_modulus`](super::NativePass::set_modulus), behind that. Twin of `counter` in
/// shaders/methods/volumes/count.glsl.
pub(super) const MODULUS_BYTES: u32 = 4;

/// Where fragment shaders find the stencil, if they count in it. Twin of `stencil` in shaders/methods/volumes/count.glsl.
pub const STENCIL_BINDING: u32 = 16;

/// Descriptor set 0: buffers at bindings 0, 1, 2, ... in the order given, and the stencil of a target whose fragment shaders
/// count in it; and constants of five `u32`.
pub struct Bindings {
    pub(super) layout: vk::PipelineLayout,
    pub(super) set: vk::DescriptorSet,
    set_layout: vk::DescriptorSetLayout,
    pool: vk::DescriptorPool,
    raw: ash::Device,
    device: wgpu::Device,
    _buffers: Vec<wgpu::Buffer>,
    /// With what it is a view of.
    stencil: Option<(vk::ImageView, wgpu::Texture)>,
}

impl Bindings {
    /// Binds whole buffers, visible to every stage, for passes over `target`.
    ///
    /// # Errors
    /// When the device does not run on Vulkan or is out of memory.
    pub fn new(
        device: &wgpu::Device,
        target: &Target,
        buffers: &[(BindingKind, &wgpu::Buffer)],
    ) -> Result<Self, NativeError> {
        assert!(buffers.len() <= STENCIL_BINDING as usize);
        let raw = raw_device(device)?;
        let reads_stencil = matches!(target.counts, CountIn::StencilInShaders);
        let mut made = Self::unbound(raw, device, buffers, reads_stencil)?;
        if reads_stencil {
            made.bind_stencil(&target.depth)?;
        }
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

    /// The set with its layout, before it has anything bound.
    fn unbound(
        raw: ash::Device,
        device: &wgpu::Device,
        buffers: &[(BindingKind, &wgpu::Buffer)],
        reads_stencil: bool,
    ) -> Result<Self, NativeError> {
        let (slots, sizes) = slots(buffers, reads_stencil);
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
            stencil: None,
        })
    }

    fn bind_stencil(&mut self, depth: &wgpu::Texture) -> Result<(), NativeError> {
        let view = create_view(&self.raw, depth, vk::ImageAspectFlags::STENCIL)?;
        self.stencil = Some((view, depth.clone()));
        let infos = [vk::DescriptorImageInfo::default()
            .image_view(view)
            .image_layout(INPUT_LAYOUT)];
        let write = vk::WriteDescriptorSet::default()
            .dst_set(self.set)
            .dst_binding(STENCIL_BINDING)
            .descriptor_type(vk::DescriptorType::INPUT_ATTACHMENT)
            .image_info(&infos);
        // SAFETY: the set has such a binding, and the view lives as long as the set.
        unsafe { self.raw.update_descriptor_sets(&[write], &[]) };
        Ok(())
    }
}

impl Drop for Bindings {
    fn drop(&mut self) {
        wait_idle(&self.device);
        // SAFETY: nothing that was submitted still runs, and these handles are ours alone.
        unsafe {
            if let Some((view, _)) = &self.stencil {
                self.raw.destroy_image_view(*view, None);
            }
            self.raw.destroy_pipeline_layout(self.layout, None);
            self.raw.destroy_descriptor_pool(self.pool, None);
            self.raw
                .destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

/// What a set has room for, and what a pool needs for one such set.
fn slots(
    buffers: &[(BindingKind, &wgpu::Buffer)],
    reads_stencil: bool,
) -> (
    Vec<vk::DescriptorSetLayoutBinding<'static>>,
    Vec<vk::DescriptorPoolSize>,
) {
    let all = vk::ShaderStageFlags::ALL;
    let of_buffers = buffers.iter().map(|(kind, _)| descriptor_type(*kind));
    let of_buffers = (0..).zip(of_buffers).map(|(slot, ty)| (slot, ty, all));
    let stencil = reads_stencil.then_some((
        STENCIL_BINDING,
        vk::DescriptorType::INPUT_ATTACHMENT,
        vk::ShaderStageFlags::FRAGMENT,
    ));
    let slot = |(binding, ty, stages)| {
        let slot = vk::DescriptorSetLayoutBinding::default()
            .binding(binding)
            .descriptor_count(1)
            .descriptor_type(ty)
            .stage_flags(stages);
        let size = vk::DescriptorPoolSize {
            ty,
            descriptor_count: 1,
        };
        (slot, size)
    };
    of_buffers.chain(stencil).map(slot).unzip()
}

fn draw_constants() -> vk::PushConstantRange {
    vk::PushConstantRange::default()
        .stage_flags(vk::ShaderStageFlags::ALL)
        .size(DRAW_CONSTANTS_BYTES + MODULUS_BYTES)
}

fn descriptor_type(kind: BindingKind) -> vk::DescriptorType {
    match kind {
        BindingKind::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
        BindingKind::Storage => vk::DescriptorType::STORAGE_BUFFER,
    }
}
