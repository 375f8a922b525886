//! A small stress run, made up.

use crate::record::Image;
use crate::record::stress::{
    CauseRecord, FAILURES_DIR, FORMAT, Outcome, ROWS_FILE, STRESS_FILE, StressInfo, StressMethod,
    StressRow,
};
use crate::record::{DeviceRecord, HostRecord};
use std::fs;
use std::path::Path;

/// Size of its pictures.
const SIZE_PX: (u32, u32) = (8, 6);

fn cause(id: &str, title: &str, values: &[f64]) -> CauseRecord {
    CauseRecord {
        id: id.to_owned(),
        title: title.to_owned(),
        number: "copies".to_owned(),
        why: "It is hard.".to_owned(),
        values: values.to_vec(),
    }
}

fn method(id: &str, variant: &str) -> StressMethod {
    StressMethod {
        id: id.to_owned(),
        variant: variant.parse().unwrap(),
        tolerated_share: 0.0,
        declared: Vec::new(),
    }
}

/// Three causes, three methods.
pub(super) fn info() -> StressInfo {
    StressInfo {
        files: Vec::new(),
        format: FORMAT,
        complete: true,
        title: "Where it <hurts>".to_owned(),
        program_version: "1.2.3".to_owned(),
        program_git: "abc".to_owned(),
        started: "2026-03-09T14:05:06+01:00".to_owned(),
        duration_s: 90.0,
        command: vec!["svbench".to_owned()],
        device: DeviceRecord {
            name: "A GPU".to_owned(),
            ..DeviceRecord::default()
        },
        host: HostRecord::default(),
        seed: 7,
        width: SIZE_PX.0,
        height: SIZE_PX.1,
        shader_hash: "feed".to_owned(),
        config_path: "made_up.toml".to_owned(),
        config_text: "seed = 7".to_owned(),
        causes: vec![
            cause("calm", "Nothing <b>much</b>", &[0.0, 0.35]),
            cause("duplicated", "Every triangle several times", &[1.0, 257.0]),
            cause("needles", "Long & thin", &[1e-6, 0.5]),
        ],
        methods: vec![
            method("triangle_ts", "counting=z_pass,determinism=none"),
            method("shadow_map", ""),
            method("ray_query", ""),
        ],
    }
}

fn row(cause: &str, value: f64, method: &StressMethod) -> StressRow {
    StressRow {
        cause: cause.to_owned(),
        value,
        method: method.id.clone(),
        variant: method.variant.clone(),
        outcome: Outcome::Right,
        artifact_px: 0,
        boundary_px: 2,
        false_lit: 0,
        false_shadowed: 0,
        ambiguous_px: 0,
        kinds: String::new(),
        reason: String::new(),
        picture: String::new(),
    }
}

/// All right, save what [`spoil`] says.
pub(super) fn rows(info: &StressInfo) -> Vec<StressRow> {
    let mut rows = Vec::new();
    for cause in &info.causes {
        for &value in &cause.values {
            let of = |method| spoil(row(&cause.id, value, method));
            rows.extend(info.methods.iter().map(of));
        }
    }
    rows
}

fn spoil(row: StressRow) -> StressRow {
    let (outcome, artifact_px) = match (&*row.cause, &*row.method, row.value) {
        (_, "ray_query", _) => (Outcome::Unavailable, 0),
        ("duplicated", "triangle_ts", 257.0..) => (Outcome::Undeclared, 12),
        ("duplicated", "shadow_map", 1.0) => (Outcome::Declared, 1500),
        ("duplicated", "shadow_map", _) => (Outcome::Undeclared, 700),
        ("needles", "triangle_ts", ..0.1) => (Outcome::Declared, 3),
        ("needles", "triangle_ts", _) => (Outcome::Declared, 40),
        _ => return row,
    };
    let (reason, picture) = match outcome {
        Outcome::Unavailable => ("no ray queries", ""),
        Outcome::Declared => ("a <limit>", "a.png"),
        _ => ("", "b.png"),
    };
    StressRow {
        outcome,
        artifact_px,
        false_lit: artifact_px,
        kinds: "leak=2;hole=10;seam=0".to_owned(),
        reason: reason.to_owned(),
        picture: picture.to_owned(),
        ..row
    }
}

/// Writes a run into `dir`.
pub(super) fn write(dir: &Path, info: &StressInfo, rows: &[StressRow]) {
    fs::write(
        dir.join(STRESS_FILE),
        serde_json::to_string_pretty(info).unwrap(),
    )
    .unwrap();
    let mut writer = csv::Writer::from_path(dir.join(ROWS_FILE)).unwrap();
    for row in rows {
        writer.serialize(row).unwrap();
    }
    writer.flush().unwrap();
}

/// Writes the picture `a.png`; `b.png` stays missing.
pub(super) fn write_picture(dir: &Path) {
    let folder = dir.join(FAILURES_DIR);
    fs::create_dir_all(&folder).unwrap();
    let (width, height) = (3 * SIZE_PX.0 + 8, SIZE_PX.1);
    let bytes = vec![90; (3 * width * height) as usize];
    Image::rgb((width, height), &bytes)
        .write_png(&folder.join("a.png"))
        .unwrap();
}
