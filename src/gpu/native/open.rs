//! Opening the device with tessellation and geometry shaders switched on.

use ash::vk;
use serde::Serialize;
use wgpu::hal::api::Vulkan;

/// Which of the stages that wgpu lacks can be used.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct StageSupport {
    /// Tessellation control and evaluation shaders.
    pub tessellation: bool,
    /// Geometry shaders.
    pub geometry: bool,
    /// Storage buffers may be written in the stages before the rasteriser (used by tests only).
    pub vertex_stores: bool,
    /// A depth buffer of 24 bits with 8 bits of stencil.
    pub depth24: bool,
}

/// A device with its queue.
pub struct Opened {
    /// wgpu's device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// The native stages that are switched on.
    pub stages: StageSupport,
}

/// What the adapter could offer; nothing where it does not run on Vulkan.
pub fn support(adapter: &wgpu::Adapter) -> StageSupport {
    // SAFETY: the adapter is only asked for its properties.
    let Some(hal) = (unsafe { adapter.as_hal::<Vulkan>() }) else {
        return StageSupport::default();
    };
    let instance = hal.shared_instance().raw_instance();
    let physical = hal.raw_physical_device();
    // SAFETY: `physical` belongs to `instance`, and both outlive `hal`.
    let features = unsafe { instance.get_physical_device_features(physical) };
    // Asked here: wgpu takes 32 bits without a word where there are no 24.
    // SAFETY: as above.
    let depth24 = unsafe {
        instance.get_physical_device_format_properties(physical, vk::Format::D24_UNORM_S8_UINT)
    };
    StageSupport {
        tessellation: features.tessellation_shader == vk::TRUE,
        geometry: features.geometry_shader == vk::TRUE,
        vertex_stores: features.vertex_pipeline_stores_and_atomics == vk::TRUE,
        depth24: depth24.optimal_tiling_features.contains(
            vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT
                | vk::FormatFeatureFlags::SAMPLED_IMAGE,
        ),
    }
}

/// Whether the loader of the adapter has the validation layer; `None` where it does not run on Vulkan.
pub fn has_validation_layer(adapter: &wgpu::Adapter) -> Option<bool> {
    // SAFETY: the adapter is only asked for its loader.
    let hal = unsafe { adapter.as_hal::<Vulkan>() }?;
    // SAFETY: `hal` keeps the loader alive, and nothing of it is kept.
    let layers = unsafe {
        hal.shared_instance()
            .entry()
            .enumerate_instance_layer_properties()
    };
    let is_it = |layer: &vk::LayerProperties| {
        layer.layer_name_as_c_str() == Ok(c"VK_LAYER_KHRONOS_validation")
    };
    Some(layers.is_ok_and(|layers| layers.iter().any(is_it)))
}

/// Opens the adapter with `features`, and with every native stage that it has.
///
/// # Errors
/// The driver's words.
pub fn open(adapter: &wgpu::Adapter, features: wgpu::Features) -> Result<Opened, String> {
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("svbench"),
        required_features: features,
        required_limits: adapter.limits(),
        ..Default::default()
    };
    let stages = support(adapter);
    let (device, queue) = if stages == StageSupport::default() {
        pollster::block_on(adapter.request_device(&descriptor)).map_err(|e| e.to_string())?
    } else {
        open_vulkan(adapter, &descriptor, stages)?
    };
    Ok(Opened {
        device,
        queue,
        stages,
    })
}

/// wgpu keeps the core Vulkan feature set private, so the device is created here with wgpu's own
/// extensions and features plus the native stages, and then handed to wgpu.
fn open_vulkan(
    adapter: &wgpu::Adapter,
    descriptor: &wgpu::DeviceDescriptor<'_>,
    stages: StageSupport,
) -> Result<(wgpu::Device, wgpu::Queue), String> {
    // wgpu always takes the first queue of the first family.
    const QUEUE_FAMILY: u32 = 0;
    // SAFETY: the adapter is borrowed for the length of this function and not destroyed.
    let hal = unsafe { adapter.as_hal::<Vulkan>() }.ok_or("not a Vulkan adapter")?;
    let features = descriptor.required_features;
    let extensions = hal.required_device_extensions(features);
    let mut enabled = hal.physical_device_features(&extensions, features);
    let mut core = enabled.get_core();
    core.tessellation_shader = vk::Bool32::from(stages.tessellation);
    core.geometry_shader = vk::Bool32::from(stages.geometry);
    // Only ever added: wgpu may have asked for it as well.
    core.vertex_pipeline_stores_and_atomics |= vk::Bool32::from(stages.vertex_stores);

    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(QUEUE_FAMILY)
        .queue_priorities(&[1.0])];
    let extension_names: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
    let info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&extension_names);
    let info = enabled.add_to_device_create(info).enabled_features(&core);
    // SAFETY: extensions and features are those that wgpu would ask for, plus stages that
    // `support` found; every pointer in `info` lives until after the call.
    let raw = unsafe {
        hal.shared_instance()
            .raw_instance()
            .create_device(hal.raw_physical_device(), &info, None)
    }
    .map_err(|error| error.to_string())?;
    // SAFETY: `raw` was created from this adapter with the queue family, extensions and a superset
    // of the features passed here; wgpu takes ownership of it.
    let open = unsafe {
        hal.device_from_raw(
            raw,
            None,
            &extensions,
            features,
            &descriptor.required_limits,
            &descriptor.memory_hints,
            QUEUE_FAMILY,
            0,
        )
    }
    .map_err(|error| error.to_string())?;
    drop(hal);
    // SAFETY: `open` was made from this adapter, with at least `descriptor`'s features.
    unsafe { adapter.create_device_from_hal(open, descriptor) }.map_err(|error| error.to_string())
}
