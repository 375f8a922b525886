//! The device, opened.

use super::adapter::{REQUIRED, adapters, choose, unsuitable};
use super::capability::Capability;
use super::error::GpuError;
use super::fault::{DeviceError, Faults, PollFault, poll};
use super::native;
use super::uploads::Uploads;
use crate::memory;
use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What the caller wants of the device.
#[derive(Debug, Clone, Default)]
pub struct GpuOptions {
    /// Pick the adapter whose name contains this text (case-insensitive); else the best one.
    pub adapter: Option<String>,
    /// Switch the driver's validation layers on and collect their messages.
    pub validation: bool,
    /// Open the device as if it did not have these.
    pub hidden: Vec<Capability>,
}

/// The opened device. A clone is the same device.
#[derive(Clone)]
pub struct Gpu {
    /// wgpu's device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// What the adapter says of itself.
    pub info: wgpu::AdapterInfo,
    pub(super) memory: MemoryLimits,
    pub(super) uploads: Arc<Uploads>,
    capabilities: BTreeSet<Capability>,
    faults: Arc<Faults>,
    options: GpuOptions,
}

/// What is known of memory when the device is opened.
#[derive(Debug, Clone, Copy)]
pub(super) struct MemoryLimits {
    /// The most bytes that it gives in one allocation.
    pub(super) most_at_once: u64,
    /// What the machine had left.
    pub(super) host_at_opening: Option<u64>,
}

/// The device is waited for so long at least, however late it is: what it was given late deserves a chance.
const LEAST_WAIT: Duration = Duration::from_secs(2);

impl Gpu {
    /// Opens an adapter: the one named in `options`, else a discrete GPU before an integrated one
    /// before a software one.
    ///
    /// # Errors
    /// [`GpuError`] when there is no adapter, none of that name, or it lacks what every run needs.
    pub fn open(options: &GpuOptions) -> Result<Self, GpuError> {
        let adapter = choose(adapters(options.validation), options.adapter.as_deref())?;
        let info = adapter.get_info();
        if let Some(missing) = unsuitable(&adapter) {
            return Err(GpuError::Unsuitable {
                adapter: info.name,
                missing,
            });
        }
        if options.validation {
            match native::has_validation_layer(&adapter) {
                Some(true) => {}
                Some(false) => return Err(GpuError::NoValidationLayer),
                None => {
                    return Err(GpuError::ValidationNeedsVulkan {
                        adapter: info.name,
                        backend: info.backend.to_string(),
                    });
                }
            }
        }
        let mut capabilities = native::supported(&adapter);
        capabilities.retain(|capability| !options.hidden.contains(capability));
        let (device, queue) =
            native::open(&adapter, REQUIRED, &capabilities).map_err(|reason| GpuError::Open {
                adapter: info.name.clone(),
                reason,
            })?;
        Ok(Self {
            memory: MemoryLimits {
                most_at_once: native::most_bytes_at_once(&device),
                host_at_opening: memory::available_bytes(),
            },
            faults: Faults::of(&device),
            uploads: Arc::new(Uploads::new(&device)),
            options: options.clone(),
            device,
            queue,
            info,
            capabilities,
        })
    }

    /// The format of the frame's depth buffer: 32-bit float, with stencil where the device can.
    pub fn depth_format(&self) -> wgpu::TextureFormat {
        if self.has(Capability::StencilBuffer) {
            wgpu::TextureFormat::Depth32FloatStencil8
        } else {
            wgpu::TextureFormat::Depth32Float
        }
    }

    /// Largest side of a 2D texture.
    pub fn max_texture_px(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// Whether the device has a capability.
    pub fn has(&self, capability: Capability) -> bool {
        self.capabilities.contains(&capability)
    }

    /// Whether the device has a capability that something needs; if not, the reason.
    ///
    /// # Errors
    /// The reason, as a sentence for people.
    pub fn check(&self, capability: Capability) -> Result<(), String> {
        if self.has(capability) {
            return Ok(());
        }
        let words = capability.words();
        Err(if self.info.backend == wgpu::Backend::Vulkan {
            format!("needs {words}, which {} does not have", self.info.name)
        } else {
            format!("needs {words}; this device runs on {}", self.info.backend)
        })
    }

    /// Whether the device is a software rasteriser, whose absolute times mean little.
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Waits until all submitted work is done.
    pub fn wait_idle(&self) {
        // A lost device ends the wait as well; the next attempt will say so.
        let _ = self.poll(wgpu::PollType::wait_indefinitely());
    }

    /// Waits as `how` says, yet not beyond the deadline of [`Self::until`].
    ///
    /// # Errors
    /// When the device is lost, or is given up because it is late.
    pub(super) fn poll(&self, how: wgpu::PollType) -> Result<(), DeviceError> {
        if let Some(lost) = self.lost().filter(|_| self.hangs()) {
            return Err(lost);
        }
        let how = match (how, self.faults.deadline()) {
            (
                wgpu::PollType::Wait {
                    submission_index, ..
                },
                Some(deadline),
            ) => wgpu::PollType::Wait {
                submission_index,
                timeout: Some(
                    deadline
                        .saturating_duration_since(Instant::now())
                        .max(LEAST_WAIT),
                ),
            },
            (how, _) => how,
        };
        poll(&self.device, how).map_err(|fault| match fault {
            PollFault::Lost(text) => DeviceError::Lost(text),
            PollFault::Late => {
                // To close it would be to wait for it.
                std::mem::forget(self.clone());
                self.faults.hang()
            }
        })
    }

    /// Does `work`, in which the device is waited for until `deadline` and no longer: then it is given up, as if it
    /// were lost. Nothing can stop what it is doing; see [`Self::hangs`].
    pub fn until<T>(&self, deadline: Option<Instant>, work: impl FnOnce() -> T) -> T {
        let before = self.faults.replace_deadline(deadline);
        let result = work();
        self.faults.replace_deadline(before);
        result
    }

    /// Whether the device was given up because it was late. It may still use what was made on it, so that none of
    /// it may be dropped.
    pub fn hangs(&self) -> bool {
        self.faults.hangs()
    }

    /// Does `work`. What the device has against any part of it is the error, rather than what followed from
    /// that.
    ///
    /// # Errors
    /// When the device is lost or refuses something, or `work` fails.
    pub fn attempt<T, E: From<DeviceError>>(
        &self,
        work: impl FnOnce() -> Result<T, E>,
    ) -> Result<T, E> {
        if let Some(lost) = self.lost() {
            return Err(lost.into());
        }
        let result = work();
        let fault = self.faults.take();
        if result.is_ok() && fault.is_none() {
            return result;
        }
        // The device may be gone and not have said so yet.
        let polled = self.poll(wgpu::PollType::Poll);
        let lost = self.lost();
        if lost.is_some() && !self.hangs() {
            native::settle(&self.device);
        }
        match lost.or(fault).or(polled.err()) {
            Some(fault) => Err(fault.into()),
            None => result,
        }
    }

    /// The device's loss, if it is lost: nothing works on it any more.
    pub fn lost(&self) -> Option<DeviceError> {
        self.faults.lost()
    }

    /// The same adapter opened again, after a loss.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn reopen(&self) -> Result<Self, GpuError> {
        Self::open(&self.options)
    }
}
