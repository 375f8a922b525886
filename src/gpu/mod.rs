//! The graphics device and what the upper floors need of it: opening it with the stages that wgpu
//! lacks, shaders, timing and reading back.
//!
//! This is the only room with `unsafe` code. [`native`] holds all that talks to Vulkan directly;
//! its public face is safe.
//!
//! wgpu has no tessellation and geometry stages and no control over barriers, so methods that need them draw
//! with Vulkan in the midst of a frame of wgpu's. A frame is therefore recorded in one place, [`FrameRecorder`], which
//! sets timestamps and barriers between the two. For example, a [`Stage`] that uploads vertices, computes silhouettes in
//! a compute pass and draws them natively needs no word about any of this; its time on the device and on the processor
//! is told apart in [`FrameTimes`].

pub mod acceleration;
mod adapter;
mod capability;
mod depth;
mod device;
mod error;
mod fault;
pub mod messages;
pub mod native;
pub mod readback;
pub mod recorder;
mod resource;
pub mod shader;
mod stage;
mod ticket;
pub mod timeline;
pub mod timer;
mod timestamps;
mod uploads;

pub use adapter::{DeviceSummary, list_devices, type_name};
pub use capability::Capability;
pub use depth::DepthDirection;
pub use device::{Gpu, GpuOptions};
pub use error::GpuError;
pub use fault::DeviceError;
pub use recorder::FrameRecorder;
pub use stage::Stage;
pub use ticket::Ticket;
pub use timeline::StageTime;
pub use timer::{FRAMES_IN_FLIGHT, FrameTimer, FrameTimes};
