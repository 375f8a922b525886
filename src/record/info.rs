//! Where a run's numbers come from: `run.json`.

use super::FileRecord;
use crate::variant::Variant;
use serde::{Deserialize, Serialize};

/// Where a run's numbers come from (`run.json`).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RunInfo {
    /// Layout of the run directory, [`super::FORMAT`] when written by this version.
    pub format: u32,
    /// How far the run came.
    pub status: RunStatus,
    /// What the run is about, from the configuration.
    pub title: String,
    /// Version of the program that measured.
    pub program_version: String,
    /// Git revision of the program that measured; empty when not built from a checkout.
    pub program_git: String,
    /// When the run began, in RFC 3339.
    pub started: String,
    /// The command line, program name first.
    pub command: Vec<String>,
    /// The device measured.
    pub device: DeviceRecord,
    /// The machine around the device.
    pub host: HostRecord,
    /// Seed of everything random in the run, the order of its cells above all.
    pub seed: u64,
    /// Width of the rendered picture in pixels.
    pub width: u32,
    /// Height of the rendered picture in pixels.
    pub height: u32,
    /// Frames measured in each cell.
    pub frames: u32,
    /// Frames rendered in each cell before measuring.
    pub warmup_frames: u32,
    /// Frames drawn before each measured and each verified one; 0 in runs from before there were any.
    #[serde(default)]
    pub lead_in: u32,
    /// Frames of each cell compared with the reference.
    pub verified_frames: u32,
    /// The scenes asked for, also those that could not be loaded.
    pub scenes: Vec<SceneRecord>,
    /// The methods asked for, also those that the device cannot run.
    pub methods: Vec<MethodRecord>,
    /// Hash over every shader source.
    pub shader_hash: String,
    /// The configuration file, as named on the command line.
    pub config_path: String,
    /// The configuration, word for word.
    pub config_text: String,
    /// The scale at which the configuration was run; empty in runs from before there were scales.
    #[serde(default)]
    pub scale: String,
    /// The most memory that the program had at once, in bytes; missing while the run is under way, where nobody says, and
    /// in runs from before it was noted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak_memory_bytes: Option<u64>,
    /// What the reader should know before trusting a number.
    pub warnings: Vec<String>,
    /// The tables and pictures as they were when the run ended; empty while it is under way, and in runs from before
    /// they were noted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<FileRecord>,
}

/// How far a run came.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RunStatus {
    /// Still measuring, or killed before it could say otherwise.
    #[default]
    Running,
    /// Every cell has its row.
    Complete,
    /// Stopped by its user.
    Interrupted,
    /// Stopped by an error.
    Failed,
}

impl RunStatus {
    /// The word in `run.json`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::Complete => "complete",
            Self::Interrupted => "interrupted",
            Self::Failed => "failed",
        }
    }
}

/// The device measured and its driver.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct DeviceRecord {
    /// Name, as the driver gives it.
    pub name: String,
    /// PCI vendor.
    pub vendor_id: u32,
    /// Kind of device: `discrete_gpu`, `integrated_gpu`, `virtual_gpu`, `cpu` or `other`.
    pub device_type: String,
    /// Name of the driver.
    pub driver: String,
    /// Version of the driver.
    pub driver_info: String,
    /// Graphics API.
    pub backend: String,
    /// Whether it has tessellation stages.
    pub tessellation: bool,
    /// Whether it has a geometry stage.
    pub geometry: bool,
}

impl DeviceRecord {
    /// Whether the "device" is a rasterizer in software, whose times say nothing about GPUs.
    pub fn is_software(&self) -> bool {
        self.device_type.eq_ignore_ascii_case("cpu")
    }
}

/// The machine around the device.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct HostRecord {
    /// Operating system.
    pub os: String,
    /// Architecture of the processor.
    pub arch: String,
    /// Logical processors.
    pub cores: u32,
}

/// A scene of the run. Counts are `None` where the scene could not be loaded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SceneRecord {
    /// Name, as in the result rows.
    pub name: String,
    /// Name for people.
    pub title: String,
    /// Width and height of its pictures, where they are not those of the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_px: Option<(u32, u32)>,
    /// Triangles that cast.
    pub triangles: Option<u64>,
    /// Objects that cast, each its own draw call.
    pub objects: Option<u64>,
    /// Hash over the mesh as drawn; empty where the scene could not be loaded.
    pub mesh_hash: String,
    /// Position of the light, or the direction towards it, at the start of the flight.
    pub light: [f32; 3],
    /// Fourth coordinate of the light: 1 at a position, 0 at infinity.
    pub light_w: f32,
    /// Whether the light moves during the flight.
    #[serde(default)]
    pub light_moves: bool,
    /// How the edges of the mesh are shared.
    pub edges: Option<EdgeRecord>,
    /// Whether the scene was measured.
    pub status: Status,
    /// Why not, where it was not.
    pub reason: String,
}

/// Edges of a mesh, by the number of triangles that share them.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct EdgeRecord {
    /// Edges of one triangle.
    pub boundary: u64,
    /// Edges between two triangles.
    pub manifold: u64,
    /// Edges between more than two triangles.
    pub non_manifold: u64,
}

/// A method of the run, in one variant.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MethodRecord {
    /// Id, as in the result rows.
    pub id: String,
    /// Parameters that tell it from its siblings; empty where there is nothing to tell.
    pub variant: Variant,
    /// Name for people.
    pub title: String,
    /// Names of the stages timed, in the order in which they run.
    pub stages: Vec<String>,
    /// The curve that it is a point of, if a list of values in the configuration made it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<SweepRecord>,
}

/// A point of a sweep: one of the values that a configuration lists for a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepRecord {
    /// Variant of the method without the swept parameter: with the id, the curve's name.
    pub curve: Variant,
    /// The swept parameter.
    pub parameter: String,
    /// Its value here.
    pub value: f64,
}

/// What became of a cell or a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// Measured, and compared with the reference.
    Ok,
    /// Not measured, on purpose or for want of a file.
    Skipped,
    /// The device cannot run it.
    Unavailable,
    /// It began and broke.
    Failed,
    /// Measured, but not compared with the reference.
    Unverified,
}

impl Status {
    /// Whether it says that there was nothing to measure, or that measuring it broke.
    pub fn is_absent(self) -> bool {
        matches!(self, Self::Skipped | Self::Unavailable | Self::Failed)
    }

    /// The word used in the result rows.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Skipped => "skipped",
            Self::Unavailable => "unavailable",
            Self::Failed => "failed",
            Self::Unverified => "unverified",
        }
    }
}
