//! What program, device and machine results come from.

use super::{DeviceRecord, HostRecord};
use crate::gpu::{Capability, Gpu};

/// Git revision of the program; empty when not built from a checkout.
pub fn program_git() -> String {
    git_version::git_version!(
        args = ["--always", "--dirty=-modified", "--abbrev=12"],
        fallback = ""
    )
    .to_owned()
}

/// The command line, program name first; what is not Unicode is told as nearly as can be.
pub fn command() -> Vec<String> {
    std::env::args_os()
        .map(|argument| argument.to_string_lossy().into_owned())
        .collect()
}

impl DeviceRecord {
    /// The device in use.
    pub fn of(gpu: &Gpu) -> Self {
        let info = &gpu.info;
        Self {
            name: info.name.clone(),
            vendor_id: info.vendor,
            device_type: crate::gpu::type_name(info.device_type).to_owned(),
            driver: info.driver.clone(),
            driver_info: info.driver_info.clone(),
            backend: info.backend.to_string(),
            tessellation: gpu.has(Capability::TessellationStage),
            geometry: gpu.has(Capability::GeometryStage),
        }
    }
}

impl HostRecord {
    /// The machine that the program runs on.
    pub fn here() -> Self {
        Self {
            os: std::env::consts::OS.to_owned(),
            arch: std::env::consts::ARCH.to_owned(),
            cores: std::thread::available_parallelism().map_or(1, |cores| cores.get() as u32),
        }
    }
}
