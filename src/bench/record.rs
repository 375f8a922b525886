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

use serde::{Deserialize, Serialize};

use super::statistics::{mean, median, p95};

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

/// Where a run's numbers come from (`run.json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunInfo {
    /// Layout of the run directory, [`FORMAT`] when written by this version.
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
    /// What the reader should know before trusting a number.
    pub warnings: Vec<String>,
}

/// How far a run came.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RunStatus {
    /// Still measuring, or killed before it could say otherwise.
    Running,
    /// Every cell has its row.
    Complete,
    /// Stopped by its user.
    Interrupted,
    /// Stopped by an error.
    Failed,
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
    /// Triangles that cast.
    pub triangles: Option<u64>,
    /// Objects that cast, each its own draw call.
    pub objects: Option<u64>,
    /// Hash over the mesh as drawn; empty where the scene could not be loaded.
    pub mesh_hash: String,
    /// Position of the light, or the direction towards it.
    pub light: [f32; 3],
    /// Fourth coordinate of the light: 1 at a position, 0 at infinity.
    pub light_w: f32,
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
    pub variant: String,
    /// Name for people.
    pub title: String,
    /// Names of the stages timed, in the order in which they run.
    pub stages: Vec<String>,
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

/// One measured frame: a row of `samples.csv`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Sample {
    /// Name of the scene.
    pub scene: String,
    /// Triangles that cast.
    pub triangles: u64,
    /// Objects that cast.
    pub objects: u64,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: String,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Number of the frame along the flight, from zero.
    pub frame: u32,
    /// Where on the flight the frame lies, in seconds.
    pub time_s: f64,
    /// Position of this frame in the order in which its scene's frames were drawn, warm-up included.
    pub order: u64,
    /// All of the frame on the device, in milliseconds.
    pub frame_ms: f64,
    /// The G-buffer.
    pub gbuffer_ms: f64,
    /// What the method adds: everything but G-buffer and shading.
    pub shadow_ms: f64,
    /// Shading.
    pub shade_ms: f64,
    /// Recording and submitting, on the processor.
    pub cpu_ms: f64,
    /// The method's stages in milliseconds, as [`stages_to_text`] writes them.
    pub stages: String,
}

/// Writes stage times as a row's `stages` field: `volumes=12.3;resolve=0.4`.
pub fn stages_to_text<'a>(stages: impl IntoIterator<Item = (&'a str, f64)>) -> String {
    let parts: Vec<String> = stages
        .into_iter()
        .map(|(name, stage_ms)| format!("{name}={stage_ms}"))
        .collect();
    parts.join(";")
}

/// Reads a row's `stages` field back; a part that is not `name=number` is left out.
pub fn stages_from_text(text: &str) -> Vec<(&str, f64)> {
    text.split(';')
        .filter_map(|part| part.rsplit_once('='))
        .filter_map(|(name, stage_ms)| Some((name, stage_ms.parse().ok()?)))
        .collect()
}

/// One point of a run's matrix, measured or not.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Cell {
    /// Name of the scene.
    pub scene: String,
    /// Triangles that cast, where the scene could be loaded.
    pub triangles: Option<u64>,
    /// Objects that cast, where the scene could be loaded.
    pub objects: Option<u64>,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: String,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
}

/// Pixels found wrong against the reference, summed over a cell's verified frames.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ErrorSums {
    /// Frames compared.
    pub verified_frames: u32,
    /// Lit, but in shadow by the reference.
    pub false_lit: u64,
    /// In shadow, but lit by the reference.
    pub false_shadowed: u64,
    /// Of the wrong ones, those farther than one pixel from the true shadow boundary.
    pub artifact_px: u64,
    /// Of the wrong ones, those within one pixel of it.
    pub boundary_px: u64,
    /// Left out of all the others, because the reference itself cannot decide.
    pub ambiguous_px: u64,
}

/// One cell: a row of `summary.csv`. Numbers are `None`, and their fields empty, where nothing was
/// measured; error counts are sums over the verified frames.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// Triangles that cast.
    pub triangles: Option<u64>,
    /// Objects that cast.
    pub objects: Option<u64>,
    /// Id of the method.
    pub method: String,
    /// Variant of the method.
    pub variant: String,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Frames measured.
    pub frames: u32,
    /// Frames by their summed time, as the literature has it: the reciprocal of the mean frame.
    pub fps: Option<f64>,
    /// Median of the frame time.
    pub frame_ms_median: Option<f64>,
    /// Median of the shadow time.
    pub shadow_ms_median: Option<f64>,
    /// 95th percentile of the shadow time.
    pub shadow_ms_p95: Option<f64>,
    /// Median of the G-buffer's time.
    pub gbuffer_ms_median: Option<f64>,
    /// See [`ErrorSums::false_lit`].
    pub false_lit: Option<u64>,
    /// See [`ErrorSums::false_shadowed`].
    pub false_shadowed: Option<u64>,
    /// See [`ErrorSums::artifact_px`].
    pub artifact_px: Option<u64>,
    /// See [`ErrorSums::ambiguous_px`].
    pub ambiguous_px: Option<u64>,
    /// What became of the cell.
    pub status: Status,
    /// Why, where it is not [`Status::Ok`].
    pub reason: String,
    /// See [`ErrorSums::boundary_px`].
    pub boundary_px: Option<u64>,
    /// Frames compared with the reference.
    pub verified_frames: u32,
    /// 95th percentile of the frame time.
    pub frame_ms_p95: Option<f64>,
    /// Median of the processor's time for a frame.
    pub cpu_ms_median: Option<f64>,
    /// Mean of the frame time.
    pub frame_ms_mean: Option<f64>,
}

impl Summary {
    /// Sums up the samples of one cell. `errors` is `None` where no frame was verified.
    pub fn from_samples(
        cell: &Cell,
        samples: &[Sample],
        errors: Option<&ErrorSums>,
        status: Status,
        reason: &str,
    ) -> Self {
        let column = |of: fn(&Sample) -> f64| samples.iter().map(of).collect::<Vec<f64>>();
        let frame_ms = column(|s| s.frame_ms);
        let shadow_ms = column(|s| s.shadow_ms);
        let total_ms: f64 = frame_ms.iter().sum();
        Self {
            scene: cell.scene.clone(),
            triangles: cell.triangles,
            objects: cell.objects,
            method: cell.method.clone(),
            variant: cell.variant.clone(),
            width: cell.width,
            height: cell.height,
            frames: u32::try_from(samples.len()).unwrap_or(u32::MAX),
            fps: (total_ms > 0.0).then(|| samples.len() as f64 * 1000.0 / total_ms),
            frame_ms_median: median(&frame_ms),
            shadow_ms_median: median(&shadow_ms),
            shadow_ms_p95: p95(&shadow_ms),
            gbuffer_ms_median: median(&column(|s| s.gbuffer_ms)),
            false_lit: errors.map(|e| e.false_lit),
            false_shadowed: errors.map(|e| e.false_shadowed),
            artifact_px: errors.map(|e| e.artifact_px),
            ambiguous_px: errors.map(|e| e.ambiguous_px),
            status,
            reason: reason.to_owned(),
            boundary_px: errors.map(|e| e.boundary_px),
            verified_frames: errors.map_or(0, |e| e.verified_frames),
            frame_ms_p95: p95(&frame_ms),
            cpu_ms_median: median(&column(|s| s.cpu_ms)),
            frame_ms_mean: mean(&frame_ms),
        }
    }
}

/// What a picture in `images/` shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageKind {
    /// The lit picture.
    Picture,
    /// The method's shadow mask.
    Mask,
    /// The mask compared with the reference.
    Error,
    /// The reference mask, one per scene; method and variant are not part of its name.
    Reference,
}

/// The file name of a picture in `images/`: `sponza__silhouette_ts__reference_edge_mask.png`.
///
/// Anything but ASCII letters, digits, `_`, `-` and inner dots becomes `-`, so that a name from a
/// configuration can neither leave the folder nor trip a file system.
pub fn image_name(scene: &str, method: &str, variant: &str, kind: ImageKind) -> String {
    let (scene, method, variant) = (file_safe(scene), file_safe(method), file_safe(variant));
    let suffix = match kind {
        ImageKind::Picture => "picture",
        ImageKind::Mask => "mask",
        ImageKind::Error => "error",
        ImageKind::Reference => return format!("{scene}__reference.png"),
    };
    if variant.is_empty() {
        format!("{scene}__{method}_{suffix}.png")
    } else {
        format!("{scene}__{method}__{variant}_{suffix}.png")
    }
}

/// `text` with every character that is not safe in a file name replaced by `-`.
pub fn file_safe(text: &str) -> String {
    let safe = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
    let name: String = text
        .chars()
        .map(|c| if safe(c) { c } else { '-' })
        .collect();
    if name.starts_with('.') {
        name.replacen('.', "-", 1)
    } else {
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(frame_ms: f64, shadow_ms: f64) -> Sample {
        Sample {
            frame_ms,
            shadow_ms,
            gbuffer_ms: 1.0,
            cpu_ms: 0.5,
            ..Sample::default()
        }
    }

    #[test]
    fn a_summary_is_the_statistics_of_its_samples() {
        let cell = Cell {
            scene: "s".into(),
            triangles: Some(12),
            ..Cell::default()
        };
        let errors = ErrorSums {
            verified_frames: 2,
            false_lit: 3,
            ..ErrorSums::default()
        };
        let samples = [sample(10.0, 4.0), sample(20.0, 8.0), sample(30.0, 6.0)];
        let summary = Summary::from_samples(&cell, &samples, Some(&errors), Status::Ok, "");
        assert_eq!(summary.frames, 3);
        assert_eq!(summary.fps, Some(50.0));
        assert_eq!(summary.frame_ms_median, Some(20.0));
        assert_eq!(summary.frame_ms_mean, Some(20.0));
        assert_eq!(summary.shadow_ms_median, Some(6.0));
        assert_eq!(summary.shadow_ms_p95, Some(7.8));
        assert_eq!(summary.gbuffer_ms_median, Some(1.0));
        assert_eq!(
            (summary.false_lit, summary.false_shadowed),
            (Some(3), Some(0))
        );
        assert_eq!(summary.verified_frames, 2);
    }

    #[test]
    fn nothing_measured_leaves_empty_fields() {
        let summary =
            Summary::from_samples(&Cell::default(), &[], None, Status::Unavailable, "no stage");
        assert_eq!(summary.fps, None);
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.serialize(&summary).unwrap();
        let text = String::from_utf8(writer.into_inner().unwrap()).unwrap();
        let (header, row) = text.trim_end().split_once('\n').unwrap();
        assert_eq!(
            header,
            "scene,triangles,objects,method,variant,width,height,frames,fps,frame_ms_median,\
             shadow_ms_median,shadow_ms_p95,gbuffer_ms_median,false_lit,false_shadowed,\
             artifact_px,ambiguous_px,status,reason,boundary_px,verified_frames,frame_ms_p95,\
             cpu_ms_median,frame_ms_mean"
        );
        assert_eq!(row, ",,,,,0,0,0,,,,,,,,,,unavailable,no stage,,0,,,");
        let back: Summary = csv::Reader::from_reader(text.as_bytes())
            .deserialize()
            .next()
            .unwrap()
            .unwrap();
        assert_eq!(back, summary);
    }

    #[test]
    fn image_names_are_safe_and_tell_cells_apart() {
        use ImageKind::{Error, Mask, Reference};
        assert_eq!(
            image_name("sponza", "ray_query", "", Mask),
            "sponza__ray_query_mask.png"
        );
        assert_eq!(
            image_name("sponza", "shadow_map", "resolution=8192", Error),
            "sponza__shadow_map__resolution-8192_error.png"
        );
        assert_eq!(
            image_name("sponza", "any", "any", Reference),
            "sponza__reference.png"
        );
        assert_eq!(
            image_name("../../a<b>", "", "", Reference),
            "-.-..-a-b-__reference.png"
        );
    }

    #[test]
    fn stages_survive_the_way_through_text() {
        let text = stages_to_text([("volumes", 12.3), ("resolve", 0.4)]);
        assert_eq!(text, "volumes=12.3;resolve=0.4");
        assert_eq!(
            stages_from_text(&text),
            [("volumes", 12.3), ("resolve", 0.4)]
        );
        assert_eq!(stages_from_text(""), []);
        assert_eq!(stages_from_text("broken;half=;whole=1"), [("whole", 1.0)]);
    }
}
