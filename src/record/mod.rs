//! What a run leaves behind: the rows and files of a **run directory**.
//!
//! The runner writes these and the report reads them, so their names, columns and units are decided
//! here and nowhere else. All of a run can be read back from its directory; the report needs no
//! device, no scene and no model.
//!
//! | file | holds |
//! |---|---|
//! | `run.json` | [`RunInfo`]: where the numbers come from |
//! | `samples.csv` | a [`Sample`] per measured frame |
//! | `summary.csv` | a [`Summary`] per cell |
//! | `errors.csv` | a [`FrameError`] per verified frame |
//! | `regions.csv` | a [`RegionRow`] per large region of artifact pixels |
//! | `bias.csv` | a [`BiasRow`] per cell whose bias was searched for |
//! | `images/` | pictures, named by [`image_name`] |

mod errors;
mod fault;
mod files;
mod image;
mod images;
mod info;
mod pairs;
pub mod provenance;
pub(crate) mod read;
mod rows;
pub(crate) mod run_dir;
pub mod statistics;
pub mod stress;

pub use errors::{BiasRow, FrameError, RegionRow};
pub(crate) use fault::{RunDirError, in_one_line};
pub use files::{FileRecord, check_files, file_records};
pub use image::Image;
pub use images::{ImageKind, earlier_image_name, image_name};
pub use info::{
    DeviceRecord, EdgeRecord, HostRecord, MethodRecord, RunInfo, RunStatus, SceneRecord, Status,
    SweepRecord,
};
pub use pairs::{pairs_from_text, pairs_to_text, sum_of_counts};
pub use rows::{Cell, Sample, Summary};
pub use run_dir::new_directory;

/// Version of the run directory's layout; raised when an older reader would misread a newer run.
pub const FORMAT: u32 = 1;
/// Name of the file that holds [`RunInfo`].
pub const RUN_FILE: &str = "run.json";
/// Name of the file that holds a [`Sample`] per measured frame.
pub const SAMPLES_FILE: &str = "samples.csv";
/// Name of the file that holds a [`Summary`] per cell.
pub const SUMMARY_FILE: &str = "summary.csv";
/// Name of the file that holds a [`FrameError`] per verified frame.
pub const ERRORS_FILE: &str = "errors.csv";
/// Name of the file that holds the largest [`RegionRow`]s of each verified frame.
pub const REGIONS_FILE: &str = "regions.csv";
/// Name of the file that holds a [`BiasRow`] per cell whose bias was searched for.
pub const BIAS_FILE: &str = "bias.csv";
/// Name of the folder that holds the pictures.
pub const IMAGES_DIR: &str = "images";
