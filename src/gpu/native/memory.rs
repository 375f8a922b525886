//! What the device says of its memory.

use ash::vk;
use wgpu::hal::api::Vulkan;

/// What is left of the largest heap that is the device's own; `None` where nobody says.
pub fn free_heap_bytes(device: &wgpu::Device) -> Option<u64> {
    // SAFETY: the device is only asked for its properties.
    let hal = unsafe { device.as_hal::<Vulkan>() }?;
    let extensions = hal.enabled_device_extensions();
    let mut budget = vk::PhysicalDeviceMemoryBudgetPropertiesEXT::default();
    let has_budget = extensions.contains(&ash::ext::memory_budget::NAME);
    let mut properties = vk::PhysicalDeviceMemoryProperties2::default();
    if has_budget {
        properties = properties.push_next(&mut budget);
    }
    let instance = hal.shared_instance().raw_instance();
    // SAFETY: the physical device belongs to the instance; the extension behind the chained structure is on.
    unsafe {
        instance.get_physical_device_memory_properties2(hal.raw_physical_device(), &mut properties);
    }
    let memory = properties.memory_properties;
    let own = (0..memory.memory_heap_count as usize).filter(|&heap| {
        let flags = memory.memory_heaps[heap].flags;
        flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL)
    });
    let largest = own.max_by_key(|&heap| memory.memory_heaps[heap].size)?;
    Some(match has_budget {
        true => budget.heap_budget[largest].saturating_sub(budget.heap_usage[largest]),
        false => memory.memory_heaps[largest].size,
    })
}

/// The most that the device gives in one allocation; `u64::MAX` where nobody says.
pub fn most_bytes_at_once(device: &wgpu::Device) -> u64 {
    // SAFETY: the device is only asked for its properties.
    let Some(hal) = (unsafe { device.as_hal::<Vulkan>() }) else {
        return u64::MAX;
    };
    let mut maintenance = vk::PhysicalDeviceMaintenance3Properties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut maintenance);
    let instance = hal.shared_instance().raw_instance();
    // SAFETY: as above; the chained structure is part of Vulkan 1.1, which every driver here has.
    unsafe {
        instance.get_physical_device_properties2(hal.raw_physical_device(), &mut properties);
    }
    match maintenance.max_memory_allocation_size {
        0 => u64::MAX,
        most => most,
    }
}
