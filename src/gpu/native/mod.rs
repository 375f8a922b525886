//! Native Vulkan inside wgpu's device: the tessellation, geometry, task and mesh stages that wgpu 30 lacks or
//! leaves unfinished.
//!
//! wgpu owns the device, the queue, buffers and textures; here the same `VkDevice` gets pipelines of
//! its own, recorded into command buffers that are submitted between wgpu's. All `unsafe` code of
//! the program lives below this module. What the callers must uphold is encoded in types: native
//! objects keep the wgpu objects that they refer to alive, and wait for the device before they are
//! destroyed.
#![allow(
    unsafe_code,
    reason = "native Vulkan calls; each block states why it is sound"
)]

mod bindings;
mod counting;
mod geometry;
mod image;
mod memory;
mod open;
mod pass;
mod pipeline;
mod support;
mod target;

pub use bindings::{BindingKind, Bindings, STENCIL_BINDING};
pub use counting::{CountIn, Raster};
pub use geometry::{IndexedGeometry, IndirectDraws};
pub use image::depth_stencil_input;
pub use memory::{free_heap_bytes, most_bytes_at_once};
pub use open::open;
pub use pass::NativePass;
pub use pipeline::{Pipeline, PipelineDesc, PrimitiveTopology, VertexInput};
pub use support::{has_validation_layer, supported};
pub use target::Target;

use super::DeviceError;
use wgpu::hal::api::Vulkan;

/// Why a native object could not be made.
#[derive(Debug, thiserror::Error)]
pub enum NativeError {
    /// The device is not a Vulkan device.
    #[error("native shader stages need Vulkan")]
    NotVulkan,
    /// A Vulkan call failed.
    #[error("a Vulkan call failed")]
    Vulkan(#[from] ash::vk::Result),
}

impl From<NativeError> for DeviceError {
    fn from(error: NativeError) -> Self {
        use ash::vk::Result as Code;
        match error {
            NativeError::Vulkan(
                Code::ERROR_OUT_OF_DEVICE_MEMORY | Code::ERROR_OUT_OF_HOST_MEMORY,
            ) => Self::OutOfMemory(error.to_string()),
            NativeError::Vulkan(error) => Self::Refused(error.to_string()),
            NativeError::NotVulkan => Self::Refused(error.to_string()),
        }
    }
}

/// The Vulkan device below wgpu's. The returned handle is a table of functions and the handle
/// itself; whoever keeps it must also keep a clone of `device`, which owns it.
fn raw_device(device: &wgpu::Device) -> Result<ash::Device, NativeError> {
    // SAFETY: the handle is only borrowed; it is not destroyed, and callers keep `device` alive.
    let hal = unsafe { device.as_hal::<Vulkan>() }.ok_or(NativeError::NotVulkan)?;
    Ok(hal.raw_device().clone())
}

/// Waits for a device that was lost to come to rest: some drivers go on for a while with what they were given,
/// and nothing may be destroyed under them.
pub fn settle(device: &wgpu::Device) {
    if let Ok(raw) = raw_device(device) {
        // SAFETY: the handle is borrowed from `device`, and this thread is the only one that submits. That the
        // device is lost is known, so the result says nothing.
        let _ = unsafe { raw.device_wait_idle() };
    }
}

/// Waits until nothing that was submitted is running any more, so that objects may be destroyed.
fn wait_idle(device: &wgpu::Device) {
    // A lost device runs nothing either.
    let _ = super::fault::poll(device, wgpu::PollType::wait_indefinitely());
}
