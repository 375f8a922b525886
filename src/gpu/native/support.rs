//! What an adapter has.

use crate::gpu::capability::{Capability, ExtensionFeature, Source};
use ash::vk;
use std::collections::BTreeSet;
use wgpu::hal::api::Vulkan;
use wgpu::hal::vulkan::Adapter;

/// What of the table of capabilities the adapter has: where it does not run on Vulkan, what wgpu says it has.
pub fn supported(adapter: &wgpu::Adapter) -> BTreeSet<Capability> {
    // SAFETY: the adapter is only asked for its properties.
    let hal = unsafe { adapter.as_hal::<Vulkan>() };
    let has = |capability: &Capability| match capability.source() {
        Source::Wgpu(features) => adapter.features().contains(features),
        source => hal.as_ref().is_some_and(|hal| vulkan_has(hal, source)),
    };
    let all = Capability::ALL.iter().copied();
    all.filter(has).collect()
}

fn vulkan_has(adapter: &Adapter, source: Source) -> bool {
    let instance = adapter.shared_instance().raw_instance();
    let physical = adapter.raw_physical_device();
    match source {
        Source::Wgpu(_) => false,
        Source::VulkanFeature(bit) => {
            // SAFETY: `physical` belongs to `instance`, and both outlive `adapter`.
            let mut core = unsafe { instance.get_physical_device_features(physical) };
            *bit(&mut core) == vk::TRUE
        }
        Source::VulkanExtension(name, feature) => {
            adapter
                .physical_device_capabilities()
                .supports_extension(name)
                && feature.is_none_or(|feature| has_features(adapter, feature().as_mut()))
        }
        Source::VulkanExtension12(name, features) => {
            // SAFETY: as above.
            let properties = unsafe { instance.get_physical_device_properties(physical) };
            properties.api_version >= vk::API_VERSION_1_2
                && vulkan_has(adapter, Source::VulkanExtension(name, Some(features)))
        }
        Source::VulkanFormat(format, uses) => {
            // SAFETY: as above.
            let properties =
                unsafe { instance.get_physical_device_format_properties(physical, format) };
            properties.optimal_tiling_features.contains(uses)
        }
    }
}

fn has_features(adapter: &Adapter, features: &mut dyn ExtensionFeature) -> bool {
    let instance = adapter.shared_instance();
    // Before 1.1 the question is of an extension that the instance need not have.
    if instance.instance_api_version() < vk::API_VERSION_1_1 {
        return false;
    }
    let mut all = vk::PhysicalDeviceFeatures2::default().push_next(features.for_query());
    let physical = adapter.raw_physical_device();
    // SAFETY: as in `vulkan_has`; the structure is of an extension that the device has, and is written to as long as
    // `features` is borrowed.
    unsafe {
        instance
            .raw_instance()
            .get_physical_device_features2(physical, &mut all);
    }
    features.bits().iter().all(|bit| **bit == vk::TRUE)
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
