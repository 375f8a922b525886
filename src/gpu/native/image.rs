//! Images that are used in a way that wgpu does not know.

use super::target::format;
use super::{NativeError, raw_device};
use ash::vk;
use wgpu::hal::{MemoryFlags, api::Vulkan};

/// A two-dimensional depth-stencil texture of a format that a [`Target`](super::Target) takes, which fragment shaders of
/// native passes can read while it is drawn into. wgpu asks for no such images.
///
/// # Errors
/// When the device does not run on Vulkan or is out of memory.
pub fn depth_stencil_input(
    device: &wgpu::Device,
    desc: &wgpu::TextureDescriptor<'_>,
) -> Result<wgpu::Texture, NativeError> {
    let raw = raw_device(device)?;
    let info = vk::ImageCreateInfo::default()
        .image_type(vk::ImageType::TYPE_2D)
        .format(format(desc.format))
        .extent(vk::Extent3D {
            width: desc.size.width,
            height: desc.size.height,
            depth: 1,
        })
        .mip_levels(1)
        .array_layers(1)
        .samples(vk::SampleCountFlags::TYPE_1)
        .usage(usage(desc.usage) | vk::ImageUsageFlags::INPUT_ATTACHMENT);
    // SAFETY: the format is one of depth and stencil, which this usage is made for.
    let image = unsafe { raw.create_image(&info, None) }?;
    match bind_memory(device, &raw, image) {
        Ok(memory) => Ok(wrap(device, desc, image, memory)),
        Err(error) => {
            // SAFETY: nothing else knows of the image.
            unsafe { raw.destroy_image(image, None) };
            Err(error)
        }
    }
}

/// What wgpu would ask for.
fn usage(usage: wgpu::TextureUsages) -> vk::ImageUsageFlags {
    use vk::ImageUsageFlags as Native;
    use wgpu::TextureUsages as Wgpu;
    [
        (Wgpu::RENDER_ATTACHMENT, Native::DEPTH_STENCIL_ATTACHMENT),
        (Wgpu::TEXTURE_BINDING, Native::SAMPLED),
        (Wgpu::COPY_SRC, Native::TRANSFER_SRC),
        (Wgpu::COPY_DST, Native::TRANSFER_DST),
    ]
    .into_iter()
    .filter(|(of_wgpu, _)| usage.contains(*of_wgpu))
    .fold(Native::empty(), |all, (_, native)| all | native)
}

/// Memory of the device for an image, and for nothing else.
fn bind_memory(
    device: &wgpu::Device,
    raw: &ash::Device,
    image: vk::Image,
) -> Result<vk::DeviceMemory, NativeError> {
    // SAFETY: the handles are borrowed, to ask for properties of a device and of an image of it.
    let (needs, types) = unsafe {
        let hal = device.as_hal::<Vulkan>().ok_or(NativeError::NotVulkan)?;
        let instance = hal.shared_instance().raw_instance();
        let types = instance.get_physical_device_memory_properties(hal.raw_physical_device());
        (raw.get_image_memory_requirements(image), types)
    };
    let fits = |&number: &u32| {
        let flags = types.memory_types[number as usize].property_flags;
        needs.memory_type_bits >> number & 1 == 1
            && flags.contains(vk::MemoryPropertyFlags::DEVICE_LOCAL)
    };
    let memory_type = (0..types.memory_type_count).find(fits);
    let info = vk::MemoryAllocateInfo::default()
        .allocation_size(needs.size)
        .memory_type_index(memory_type.ok_or(vk::Result::ERROR_OUT_OF_DEVICE_MEMORY)?);
    // SAFETY: the type is one of the device's that the image may be in.
    let memory = unsafe { raw.allocate_memory(&info, None) }?;
    // SAFETY: the memory is as large as the image, which has none yet; if it stays so, nothing else knows of the memory.
    unsafe {
        if let Err(error) = raw.bind_image_memory(image, memory, 0) {
            raw.free_memory(memory, None);
            return Err(error.into());
        }
    }
    Ok(memory)
}

/// Gives wgpu an image with its memory.
fn wrap(
    device: &wgpu::Device,
    desc: &wgpu::TextureDescriptor<'_>,
    image: vk::Image,
    memory: vk::DeviceMemory,
) -> wgpu::Texture {
    use wgpu::TextureUses as Uses;
    let hal_desc = wgpu::hal::TextureDescriptor {
        label: desc.label,
        size: desc.size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: desc.format,
        usage: Uses::DEPTH_STENCIL_READ
            | Uses::DEPTH_STENCIL_WRITE
            | Uses::RESOURCE
            | Uses::COPY_SRC,
        memory_flags: MemoryFlags::empty(),
        view_formats: Vec::new(),
    };
    // SAFETY: image and memory are of this device and as the descriptors say, nobody else has them, and wgpu takes both; what
    // is in the image is not said to be anything.
    unsafe {
        let memory = wgpu::hal::vulkan::TextureMemory::Dedicated(memory);
        let hal = device
            .as_hal::<Vulkan>()
            .map(|hal| hal.texture_from_raw(image, &hal_desc, None, memory));
        let Some(texture) = hal else {
            unreachable!("the image is of a Vulkan device")
        };
        device.create_texture_from_hal::<Vulkan>(texture, desc, Uses::UNINITIALIZED)
    }
}
