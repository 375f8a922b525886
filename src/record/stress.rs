//! The files of a stress run: `stability.json` says what was tried and where, `stability.csv` has a row for
//! every picture, and the folder `failures` a picture of each method's first failure.

use crate::methods::ShadowMethod;
use crate::output;
use crate::record::{DeviceRecord, FileRecord, HostRecord};
use crate::variant::Variant;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What was tried and where.
pub const STRESS_FILE: &str = "stability.json";
/// A row for every picture.
pub const ROWS_FILE: &str = "stability.csv";
/// The folder of pictures and scenes of failures.
pub const FAILURES_DIR: &str = "failures";

/// White pixels between truth, mask and errors in a picture of a failure.
pub const GAP_PX: u32 = 4;

/// Layout of these files.
pub const FORMAT: u32 = 1;

/// What was tried and where (`stability.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressInfo {
    /// [`FORMAT`] when written by this version.
    pub format: u32,
    /// False while the run is under way, and for one that was interrupted.
    pub complete: bool,
    /// What the run is about, from the configuration.
    pub title: String,
    /// Version of the program.
    pub program_version: String,
    /// Git revision of the program; empty when not built from a checkout.
    pub program_git: String,
    /// When the run began, in RFC 3339.
    pub started: String,
    /// How long it took.
    pub duration_s: f64,
    /// The command line, program name first.
    pub command: Vec<String>,
    /// The device.
    pub device: DeviceRecord,
    /// The machine around the device.
    pub host: HostRecord,
    /// Seed of everything random.
    pub seed: u64,
    /// Width of the pictures in pixels.
    pub width: u32,
    /// Height of the pictures in pixels.
    pub height: u32,
    /// Hash over every shader source.
    pub shader_hash: String,
    /// The configuration file.
    pub config_path: String,
    /// The configuration, word for word.
    pub config_text: String,
    /// The causes, in the order in which they were tried.
    pub causes: Vec<CauseRecord>,
    /// The methods, in the order of the configuration.
    pub methods: Vec<StressMethod>,
    /// The table, pictures and scenes as they were when the run ended; empty while it is under way, and in runs from
    /// before they were noted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub files: Vec<FileRecord>,
}

impl StressInfo {
    /// Writes `stability.json` into a directory, over the one before.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&self, out: &Path) -> anyhow::Result<()> {
        output::write_with(&out.join(STRESS_FILE), |file| {
            Ok(serde_json::to_writer_pretty(file, self)?)
        })
    }
}

/// A cause of failure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CauseRecord {
    /// Its id, as in the rows.
    pub id: String,
    /// What people call it.
    pub title: String,
    /// What its number is.
    pub number: String,
    /// Which methods fail in theory, and where.
    pub why: String,
    /// The values tried.
    pub values: Vec<f64>,
}

/// A method in one variant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressMethod {
    /// Its id, as in the rows.
    pub id: String,
    /// Its parameters that are not at their defaults.
    pub variant: Variant,
    /// The part of the picture that may be wrong before that is a failure.
    pub tolerated_share: f64,
    /// The causes that its limits say bring it down.
    #[serde(default)]
    pub declared: Vec<DeclaredCause>,
}

/// A cause that a limit of a method names.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DeclaredCause {
    /// Id of the cause.
    pub cause: String,
    /// The value from which on the method is said to fail.
    pub from: f64,
    /// The limit.
    pub limit: String,
}

impl StressMethod {
    /// What results say of a method.
    pub fn of(method: &dyn ShadowMethod) -> Self {
        let variant = method.variant();
        let declared = method.info().limits_of(&variant).flat_map(|limit| {
            let declared = |(cause, from): &(&str, f64)| DeclaredCause {
                cause: (*cause).to_owned(),
                from: *from,
                limit: limit.text.to_owned(),
            };
            limit.fails.iter().map(declared)
        });
        Self {
            id: method.info().id.to_owned(),
            declared: declared.collect(),
            tolerated_share: method.info().tolerated_share,
            variant,
        }
    }

    /// Id and variant.
    pub fn name(&self) -> String {
        self.variant.full_name(&self.id)
    }
}

/// What became of one picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// As right as the method promises.
    Right,
    /// Wrong, by a limit that the method declares.
    Declared,
    /// Wrong, and nothing said that it would be.
    Undeclared,
    /// The method cannot draw this scene on this device.
    Unavailable,
    /// There is no picture: the device was lost, has not enough memory, or the scene cannot be traced.
    Failed,
}

/// One picture (`stability.csv`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StressRow {
    /// Id of the cause.
    pub cause: String,
    /// Its value.
    pub value: f64,
    /// Id of the method.
    pub method: String,
    /// Its variant.
    pub variant: Variant,
    /// What became of the picture.
    pub outcome: Outcome,
    /// Wrong pixels farther than one pixel from the true shadow boundary.
    pub artifact_px: u64,
    /// Wrong pixels within one pixel of it.
    pub boundary_px: u64,
    /// Lit, but in shadow by the truth.
    pub false_lit: u64,
    /// In shadow, but lit by the truth.
    pub false_shadowed: u64,
    /// Left out, because the truth is not certain.
    pub ambiguous_px: u64,
    /// Kinds of error and their pixels, `name=count` joined by semicolons.
    pub kinds: String,
    /// The limit that declares the failure, or why there is no picture.
    pub reason: String,
    /// Picture of the failure in the folder `failures`; empty if there is none.
    pub picture: String,
}
