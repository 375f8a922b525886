//! Opening a device with everything switched on that the program may use of it.

use crate::gpu::capability::{Capability, ExtensionFeature, Source};
use ash::vk;
use std::collections::BTreeSet;
use std::ffi::CStr;
use wgpu::hal::api::Vulkan;

/// A device and its queue.
type Opened = (wgpu::Device, wgpu::Queue);

/// Opens the adapter with `features` and with `capabilities`, which it has.
///
/// # Errors
/// The driver's words.
pub fn open(
    adapter: &wgpu::Adapter,
    features: wgpu::Features,
    capabilities: &BTreeSet<Capability>,
) -> Result<Opened, String> {
    let of_wgpu = capabilities
        .iter()
        .map(|capability| match capability.source() {
            Source::Wgpu(features) => features,
            _ => wgpu::Features::empty(),
        });
    let required_features = of_wgpu.fold(features, wgpu::Features::union);
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("svbench"),
        required_features,
        required_limits: adapter.limits(),
        experimental_features: experimental(required_features),
        ..Default::default()
    };
    // SAFETY: the adapter is only asked what it runs on.
    if unsafe { adapter.as_hal::<Vulkan>() }.is_some() {
        return open_vulkan(adapter, &descriptor, capabilities);
    }
    pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| error.to_string())
}

/// wgpu wants to be told that its unfinished features, such as ray queries and mesh shaders, may be unsound.
fn experimental(features: wgpu::Features) -> wgpu::ExperimentalFeatures {
    if !features.intersects(wgpu::Features::all_experimental_mask()) {
        return wgpu::ExperimentalFeatures::disabled();
    }
    // SAFETY: only features of the table of capabilities are asked for; whoever adds one to it has read what wgpu says
    // of its state.
    unsafe { wgpu::ExperimentalFeatures::enabled() }
}

/// wgpu keeps the core Vulkan feature set private, so the device is created here with wgpu's own
/// extensions and features plus those of `capabilities`, and then handed to wgpu.
fn open_vulkan(
    adapter: &wgpu::Adapter,
    descriptor: &wgpu::DeviceDescriptor<'_>,
    capabilities: &BTreeSet<Capability>,
) -> Result<Opened, String> {
    // wgpu always takes the first queue of the first family.
    const QUEUE_FAMILY: u32 = 0;
    // SAFETY: the adapter is borrowed for the length of this function and not destroyed.
    let hal = unsafe { adapter.as_hal::<Vulkan>() }.ok_or("not a Vulkan adapter")?;
    let features = descriptor.required_features;
    let mut extensions = hal.required_device_extensions(features);
    let mut enabled = hal.physical_device_features(&extensions, features);
    let mut core = enabled.get_core();
    let mut of_extensions = switch_on(capabilities, &mut core, &mut extensions);

    let queues = [vk::DeviceQueueCreateInfo::default()
        .queue_family_index(QUEUE_FAMILY)
        .queue_priorities(&[1.0])];
    let extension_names: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
    let info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&extension_names);
    let mut info = enabled.add_to_device_create(info).enabled_features(&core);
    for feature in &mut of_extensions {
        info = info.push_next(feature.for_device());
    }
    // SAFETY: extensions and features are those that wgpu would ask for, plus those that
    // `supported` found; every pointer in `info` lives until after the call.
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

/// Adds capabilities to the core features and the extensions of a device that wgpu would open; gives the features of
/// those extensions, on.
fn switch_on(
    capabilities: &BTreeSet<Capability>,
    core: &mut vk::PhysicalDeviceFeatures,
    extensions: &mut Vec<&'static CStr>,
) -> Vec<Box<dyn ExtensionFeature>> {
    let mut features = Vec::new();
    for capability in capabilities {
        match capability.source() {
            // Only ever switched on: wgpu may have asked for it as well.
            Source::VulkanFeature(bit) => *bit(core) = vk::TRUE,
            Source::VulkanExtension(name, feature) => {
                if !extensions.contains(&name) {
                    extensions.push(name);
                }
                features.extend(feature.map(|feature| feature()));
            }
            Source::VulkanExtension12(name, of_extension) => {
                extensions.push(name);
                features.push(of_extension());
            }
            Source::Wgpu(_) | Source::VulkanFormat(..) => {}
        }
    }
    for feature in &mut features {
        for bit in feature.bits() {
            *bit = vk::TRUE;
        }
    }
    features
}
