//! Choosing an adapter and opening it.

use super::fault::{DeviceError, Faults, PollFault, poll};
use super::messages;
use super::native;
use super::uploads::Uploads;
use crate::memory;
use serde::Serialize;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What the caller wants of the device.
#[derive(Debug, Clone, Default)]
pub struct GpuOptions {
    /// Pick the adapter whose name contains this text (case-insensitive); else the best one.
    pub adapter: Option<String>,
    /// Switch the driver's validation layers on and collect their messages.
    pub validation: bool,
}

/// A capability that a method may need beyond what every device must have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Requirement {
    /// Tessellation control and evaluation shaders.
    TessellationStage,
    /// Geometry shaders.
    GeometryStage,
    /// A 32-bit float depth buffer with 8 bits of stencil.
    StencilBuffer,
    /// A 24-bit depth buffer with 8 bits of stencil.
    Depth24,
}

impl Requirement {
    /// What is needed, as a phrase for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::TessellationStage => "tessellation shaders (Vulkan)",
            Self::GeometryStage => "geometry shaders (Vulkan)",
            Self::StencilBuffer => "a 32-bit float depth buffer with stencil",
            Self::Depth24 => "a 24-bit depth buffer with stencil (Vulkan)",
        }
    }
}

/// Why no device could be opened.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    /// The system has no driver that wgpu can use.
    #[error(
        "no graphics device found: install a Vulkan driver (scripts/run.sh installs Mesa's software driver where it may)"
    )]
    NoAdapter,
    /// `--adapter` names none of the adapters.
    #[error("no adapter's name contains `{wanted}`; there are: {}", .found.join(", "))]
    NoSuchAdapter {
        /// The name asked for.
        wanted: String,
        /// The names that exist.
        found: Vec<String>,
    },
    /// The adapter lacks something that every run needs.
    #[error("`{adapter}` cannot run svbench: it lacks {missing}")]
    Unsuitable {
        /// The adapter's name.
        adapter: String,
        /// What is missing.
        missing: String,
    },
    /// Validation is asked for where nothing validates.
    #[error(
        "--validation: `{adapter}` runs on {backend}, and the validation layers are of Vulkan alone: name another \
         device with --adapter, or leave --validation out"
    )]
    ValidationNeedsVulkan {
        /// The adapter's name.
        adapter: String,
        /// What it runs on.
        backend: String,
    },
    /// Validation is asked for and its layers are not there.
    #[error(
        "--validation: the Vulkan loader finds no layer VK_LAYER_KHRONOS_validation: install the validation layers \
         (Debian and Ubuntu: vulkan-validationlayers; Fedora: vulkan-validation-layers; else the Vulkan SDK), or \
         name their folder in VK_ADD_LAYER_PATH"
    )]
    NoValidationLayer,
    /// The driver refused to open the device.
    #[error("`{adapter}` could not be opened: {reason}")]
    Open {
        /// The adapter's name.
        adapter: String,
        /// The driver's words.
        reason: String,
    },
}

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
    /// Whether native tessellation shaders can be used.
    pub tessellation: bool,
    /// Whether native geometry shaders can be used.
    pub geometry: bool,
    /// What keeps svbench from running here at all, if anything.
    pub unsuitable: Option<String>,
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
    /// Which native stages were switched on.
    pub stages: native::StageSupport,
    pub(super) memory: MemoryLimits,
    pub(super) uploads: Arc<Uploads>,
    depth_format: wgpu::TextureFormat,
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

/// Every run times its stages.
const REQUIRED: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// The device is waited for so long at least, however late it is: what it was given late deserves a chance.
const LEAST_WAIT: Duration = Duration::from_secs(2);

/// Used where the adapter has them.
const OPTIONAL: wgpu::Features = wgpu::Features::DEPTH32FLOAT_STENCIL8;

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
        let features = REQUIRED | (OPTIONAL & adapter.features());
        let opened = native::open(&adapter, features).map_err(|reason| GpuError::Open {
            adapter: info.name.clone(),
            reason,
        })?;
        let stencil = features.contains(wgpu::Features::DEPTH32FLOAT_STENCIL8);
        Ok(Self {
            memory: MemoryLimits {
                most_at_once: native::most_bytes_at_once(&opened.device),
                host_at_opening: memory::available_bytes(),
            },
            faults: Faults::of(&opened.device),
            uploads: Arc::new(Uploads::new(&opened.device)),
            options: options.clone(),
            device: opened.device,
            queue: opened.queue,
            info,
            stages: opened.stages,
            depth_format: if stencil {
                wgpu::TextureFormat::Depth32FloatStencil8
            } else {
                wgpu::TextureFormat::Depth32Float
            },
        })
    }

    /// The format of the frame's depth buffer: 32-bit float, with stencil where the device can.
    pub fn depth_format(&self) -> wgpu::TextureFormat {
        self.depth_format
    }

    /// Largest side of a 2D texture.
    pub fn max_texture_px(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// Whether the device meets `requirement`; if not, the reason.
    ///
    /// # Errors
    /// The reason, as a sentence for people.
    pub fn check(&self, requirement: Requirement) -> Result<(), String> {
        let met = match requirement {
            Requirement::TessellationStage => self.stages.tessellation,
            Requirement::GeometryStage => self.stages.geometry,
            Requirement::Depth24 => self.stages.depth24,
            Requirement::StencilBuffer => {
                self.depth_format == wgpu::TextureFormat::Depth32FloatStencil8
            }
        };
        if met {
            return Ok(());
        }
        let label = requirement.label();
        Err(if self.info.backend == wgpu::Backend::Vulkan {
            format!("needs {label}, which {} does not have", self.info.name)
        } else {
            format!("needs {label}; this device runs on {}", self.info.backend)
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
            let stages = native::support(adapter);
            DeviceSummary {
                name: info.name,
                backend: info.backend.to_string(),
                device_type: type_name(info.device_type).to_owned(),
                driver: info.driver,
                driver_info: info.driver_info,
                tessellation: stages.tessellation,
                geometry: stages.geometry,
                unsuitable: unsuitable(adapter),
            }
        })
        .collect()
}

fn adapters(validation: bool) -> Vec<wgpu::Adapter> {
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

fn choose(adapters: Vec<wgpu::Adapter>, wanted: Option<&str>) -> Result<wgpu::Adapter, GpuError> {
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

fn unsuitable(adapter: &wgpu::Adapter) -> Option<String> {
    let missing = REQUIRED - adapter.features();
    (!missing.is_empty()).then(|| {
        missing
            .iter_names()
            .map(|(name, _)| name.to_lowercase())
            .collect::<Vec<_>>()
            .join(", ")
    })
}
