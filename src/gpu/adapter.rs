//! The adapters of this machine: listing them, and choosing one.

use super::capability::Capability;
use super::error::GpuError;
use super::messages;
use super::native;
use serde::{Serialize, Serializer};
use std::collections::BTreeSet;

/// Every run times its stages.
pub(super) const REQUIRED: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// One adapter of this machine, for `svbench list devices`.
#[derive(Debug, Clone, Serialize)]
pub struct DeviceSummary {
    /// The adapter's name.
    pub name: String,
    /// `vulkan`, `metal`, `dx12`.
    pub backend: String,
    /// As [`type_name`] has it.
    pub device_type: String,
    /// Driver name.
    pub driver: String,
    /// Driver version text.
    pub driver_info: String,
    /// Which capabilities it has; in JSON all by id, each true or false.
    #[serde(serialize_with = "yes_or_no")]
    pub capabilities: BTreeSet<Capability>,
    /// What keeps svbench from running here at all, if anything.
    pub unsuitable: Option<String>,
}

fn yes_or_no<S: Serializer>(has: &BTreeSet<Capability>, serializer: S) -> Result<S::Ok, S::Error> {
    let all = Capability::ALL.iter();
    serializer.collect_map(all.map(|capability| (capability.id(), has.contains(capability))))
}

/// `discrete_gpu`, `integrated_gpu`, `virtual_gpu`, `cpu` or `other`.
pub fn type_name(kind: wgpu::DeviceType) -> &'static str {
    match kind {
        wgpu::DeviceType::DiscreteGpu => "discrete_gpu",
        wgpu::DeviceType::IntegratedGpu => "integrated_gpu",
        wgpu::DeviceType::VirtualGpu => "virtual_gpu",
        wgpu::DeviceType::Cpu => "cpu",
        wgpu::DeviceType::Other => "other",
    }
}

/// All adapters of this machine, in the order in which they would be chosen.
pub fn list_devices() -> Vec<DeviceSummary> {
    adapters(false)
        .iter()
        .map(|adapter| {
            let info = adapter.get_info();
            DeviceSummary {
                name: info.name,
                backend: info.backend.to_string(),
                device_type: type_name(info.device_type).to_owned(),
                driver: info.driver,
                driver_info: info.driver_info,
                capabilities: native::supported(adapter),
                unsuitable: unsuitable(adapter),
            }
        })
        .collect()
}

/// All adapters, best first.
pub(super) fn adapters(validation: bool) -> Vec<wgpu::Adapter> {
    messages::install();
    let flags = if validation {
        // DEBUG as well: only with it do the layers' messages come to the logger.
        wgpu::InstanceFlags::VALIDATION | wgpu::InstanceFlags::DEBUG
    } else {
        wgpu::InstanceFlags::empty()
    };
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        flags,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    adapters.sort_by_key(|adapter| rank(&adapter.get_info()));
    adapters
}

/// Best first; Vulkan before another backend of the same device, since only it has all stages.
fn rank(info: &wgpu::AdapterInfo) -> (u8, u8) {
    let kind = match info.device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    };
    (kind, u8::from(info.backend != wgpu::Backend::Vulkan))
}

/// The adapter whose name contains `wanted`, else the best one.
pub(super) fn choose(
    adapters: Vec<wgpu::Adapter>,
    wanted: Option<&str>,
) -> Result<wgpu::Adapter, GpuError> {
    if adapters.is_empty() {
        return Err(GpuError::NoAdapter);
    }
    let Some(wanted) = wanted else {
        // A machine may list a device that lacks what we need before one that has it.
        let fit = adapters
            .iter()
            .position(|adapter| unsuitable(adapter).is_none());
        return adapters
            .into_iter()
            .nth(fit.unwrap_or(0))
            .ok_or(GpuError::NoAdapter);
    };
    let name = |adapter: &wgpu::Adapter| adapter.get_info().name;
    let found = adapters.iter().map(name).collect();
    let matches = |text: String| text.to_lowercase().contains(&wanted.to_lowercase());
    adapters
        .into_iter()
        .find(|adapter| matches(name(adapter)))
        .ok_or_else(|| GpuError::NoSuchAdapter {
            wanted: wanted.to_owned(),
            found,
        })
}

/// What keeps svbench from running on the adapter, if anything.
pub(super) fn unsuitable(adapter: &wgpu::Adapter) -> Option<String> {
    let missing = REQUIRED - adapter.features();
    (!missing.is_empty()).then(|| {
        missing
            .iter_names()
            .map(|(name, _)| name.to_lowercase())
            .collect::<Vec<_>>()
            .join(", ")
    })
}
