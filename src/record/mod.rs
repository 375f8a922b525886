//! What a run leaves behind: the rows and files of a **run directory**.
//!
//! The runner writes these and the report reads them, so their names, columns and units are decided
//! here and nowhere else. All of a run can be read back from its directory; the report needs no
//! device, no scene and no model.
//!
//! Tables are tidy: a field has one number. For example, the milliseconds of a frame's two stages are two rows of
//! `stages.csv` with the same cell and frame, so that any program that reads CSV can sum or plot them, and a new stage
//! or metric adds rows and changes no reader.
//!
//! | file | holds |
//! |---|---|
//! | `run.json` | [`RunInfo`]: where the numbers come from |
//! | `samples.csv` | a [`Sample`] per measured frame |
//! | `stages.csv` | a [`StageRow`] per stage of a measured frame |
//! | `volumes.csv` | a [`VolumeRow`] per measured frame of a method with volumes |
//! | `summary.csv` | a [`Summary`] per cell |
//! | `counters.csv` | a [`CounterRow`] per counter of a cell |
//! | `metrics.csv` | a [`MetricRow`] per metric of a verified frame |
//! | `regions.csv` | a [`RegionRow`] per large region of artifact pixels |
//! | `bias.csv` | a [`BiasRow`] per cell whose bias was searched for |
//! | `images/` | pictures, named by [`image_name`] |

mod cell;
mod counter_rows;
mod errors;
mod fault;
mod files;
mod format1;
pub mod growth;
mod image;
mod images;
mod info;
mod pairs;
pub mod provenance;
pub(crate) mod read;
mod rows;
mod run;
pub(crate) mod run_dir;
mod stage_rows;
pub mod statistics;
pub mod stress;
mod stress_run;
mod verified_frame;
mod volume_rows;

pub use cell::Cell;
pub use counter_rows::{CounterRow, counter_rows};
pub use errors::{BiasRow, RegionRow};
pub(crate) use fault::{RunDirError, in_one_line};
pub use files::{FileRecord, check_files, file_records};
pub use image::Image;
pub use images::{ImageKind, earlier_image_name, image_name};
pub use info::{
    DeviceRecord, EdgeRecord, HostRecord, MethodRecord, RunInfo, RunStatus, SceneRecord, Status,
    SweepRecord,
};
pub use pairs::{pairs_from_text, pairs_to_text};
pub use rows::{Sample, StageMs, Summary, summary_records};
pub use run::Run;
pub(crate) use run::unique;
pub use run_dir::new_directory;
pub use stage_rows::{StageRow, stage_rows};
pub use stress_run::StressRun;
pub use verified_frame::{MetricRow, VerifiedFrame, metric_rows};
pub use volume_rows::VolumeRow;

/// Version of the run directory's layout; raised when an older reader would misread a newer run.
pub const FORMAT: u32 = 2;
/// Name of the file that holds [`RunInfo`].
pub const RUN_FILE: &str = "run.json";
/// Name of the file that holds a [`Sample`] per measured frame.
pub const SAMPLES_FILE: &str = "samples.csv";
/// Name of the file that holds a [`Summary`] per cell.
pub const SUMMARY_FILE: &str = "summary.csv";
/// Name of the file that holds a [`StageRow`] per stage of a measured frame.
pub const STAGES_FILE: &str = "stages.csv";
/// Name of the file that holds a [`VolumeRow`] per measured frame of a method with volumes.
pub const VOLUMES_FILE: &str = "volumes.csv";
/// Name of the file that holds a [`CounterRow`] per counter of a cell.
pub const COUNTERS_FILE: &str = "counters.csv";
/// Name of the file that holds a [`MetricRow`] per metric of a verified frame.
pub const METRICS_FILE: &str = "metrics.csv";
/// Name of the file that holds the largest [`RegionRow`]s of each verified frame.
pub const REGIONS_FILE: &str = "regions.csv";
/// Name of the file that holds a [`BiasRow`] per cell whose bias was searched for.
pub const BIAS_FILE: &str = "bias.csv";
/// Name of the folder that holds the pictures.
pub const IMAGES_DIR: &str = "images";
