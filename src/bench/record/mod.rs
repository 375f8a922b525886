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
//! | `images/` | pictures, named by [`image_name`] |

mod images;
mod info;
mod rows;

pub use images::{ImageKind, file_safe, image_name};
pub use info::{
    DeviceRecord, EdgeRecord, HostRecord, MethodRecord, RunInfo, RunStatus, SceneRecord, Status,
};
pub use rows::{
    Cell, ErrorSums, Sample, Summary, counters_to_text, stages_from_text, stages_to_text,
};

/// Version of the run directory's layout; raised when an older reader would misread a newer run.
pub const FORMAT: u32 = 1;
/// Name of the file that holds [`RunInfo`].
pub const RUN_FILE: &str = "run.json";
/// Name of the file that holds a [`Sample`] per measured frame.
pub const SAMPLES_FILE: &str = "samples.csv";
/// Name of the file that holds a [`Summary`] per cell.
pub const SUMMARY_FILE: &str = "summary.csv";
/// Name of the folder that holds the pictures.
pub const IMAGES_DIR: &str = "images";
