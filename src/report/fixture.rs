//! Made-up run directories for the tests of the outputs.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::{LegendEntry, Run};
use crate::bench::record::{
    Cell, DeviceRecord, FORMAT, FrameError, HostRecord, MethodRecord, RUN_FILE, RunInfo, RunStatus,
    SAMPLES_FILE, SUMMARY_FILE, Sample, SceneRecord, Status, Summary,
};

pub(super) const LEGEND: [LegendEntry; 2] = [
    LegendEntry {
        label: "false lit",
        rgb: [230, 60, 40],
    },
    LegendEntry {
        label: "false shadowed",
        rgb: [40, 90, 230],
    },
];
pub(super) const HOSTILE: &str = "<script>alert(1)</script>";

pub(super) fn info(scenes: &[&str], methods: &[&str]) -> RunInfo {
    let scene = |name: &&str| SceneRecord {
        name: (*name).to_owned(),
        title: String::new(),
        triangles: Some(1000),
        objects: Some(4),
        mesh_hash: "0123".to_owned(),
        light: [3.0, 20.0, 5.0],
        light_w: 1.0,
        edges: None,
        status: Status::Ok,
        reason: String::new(),
    };
    let method = |id: &&str| MethodRecord {
        id: (*id).to_owned(),
        ..MethodRecord::default()
    };
    RunInfo {
        format: FORMAT,
        status: RunStatus::Complete,
        title: "A made-up run".to_owned(),
        program_version: "0.1.0".to_owned(),
        program_git: "abc1234".to_owned(),
        started: "2026-03-09T14:05:06Z".to_owned(),
        command: vec!["svbench".to_owned(), "run".to_owned()],
        device: DeviceRecord {
            name: "A GPU".to_owned(),
            ..DeviceRecord::default()
        },
        host: HostRecord::default(),
        seed: 7,
        width: 64,
        height: 48,
        frames: 3,
        warmup_frames: 1,
        verified_frames: 2,
        scenes: scenes.iter().map(scene).collect(),
        methods: methods.iter().map(method).collect(),
        shader_hash: "feed".to_owned(),
        config_path: "made_up.toml".to_owned(),
        config_text: "seed = 7".to_owned(),
        scale: String::new(),
        warnings: Vec::new(),
    }
}

pub(super) fn cell(info: &RunInfo, scene: &str, method: &str, triangles: u64) -> Cell {
    Cell {
        scene: scene.to_owned(),
        triangles: Some(triangles),
        objects: Some(4),
        method: method.to_owned(),
        variant: String::new(),
        width: info.width,
        height: info.height,
        counters: String::new(),
    }
}

pub(super) fn samples(cell: &Cell, shadow_ms: f64) -> Vec<Sample> {
    let sample = |frame: u32| Sample {
        scene: cell.scene.clone(),
        triangles: cell.triangles.unwrap(),
        objects: cell.objects.unwrap(),
        method: cell.method.clone(),
        width: cell.width,
        height: cell.height,
        frame,
        time_s: f64::from(frame) * 0.5,
        frame_ms: shadow_ms + 1.25,
        gbuffer_ms: 1.0,
        shadow_ms: shadow_ms + f64::from(frame) / 128.0,
        shade_ms: 0.25,
        cpu_ms: 0.125,
        record_ms: 0.0625,
        draw_calls: 12,
        stages: "volumes=1.5;resolve=0.25".to_owned(),
        ..Sample::default()
    };
    (0..3).map(sample).collect()
}

pub(super) fn write_run(dir: &Path, info: &RunInfo, samples: &[Sample], summaries: &[Summary]) {
    fs::write(
        dir.join(RUN_FILE),
        serde_json::to_string_pretty(info).unwrap(),
    )
    .unwrap();
    let mut writer = csv::Writer::from_path(dir.join(SAMPLES_FILE)).unwrap();
    samples
        .iter()
        .for_each(|row| writer.serialize(row).unwrap());
    writer.flush().unwrap();
    let mut writer = csv::Writer::from_path(dir.join(SUMMARY_FILE)).unwrap();
    summaries
        .iter()
        .for_each(|row| writer.serialize(row).unwrap());
    writer.flush().unwrap();
}

/// Two sizes of one scene; `fast` is wrong, `slow` is right, `absent` cannot run.
pub(super) fn made_up_run() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    let info = info(&["grid_n10", "grid_n20"], &["fast", "slow", "absent"]);
    let (mut all, mut summaries) = (Vec::new(), Vec::new());
    for (scene, triangles) in [("grid_n10", 1000), ("grid_n20", 4000)] {
        for (method, shadow_ms, artifact_px) in [("fast", 2.0, 1234), ("slow", 5.0, 0)] {
            let cell = cell(&info, scene, method, triangles);
            let own = samples(&cell, shadow_ms * triangles as f64 / 1000.0);
            let wrong = FrameError {
                false_lit: artifact_px + 3,
                artifact_px,
                boundary_px: 3,
                ambiguous_px: 17,
                ..FrameError::default()
            };
            let errors = [wrong, FrameError::default()];
            let row = Summary::from_samples(&cell, &own, &errors, Status::Ok, "");
            summaries.push(row);
            all.extend(own);
        }
        let cell = cell(&info, scene, "absent", triangles);
        let reason = "the device has no geometry stage";
        summaries.push(Summary::from_samples(
            &cell,
            &[],
            &[],
            Status::Unavailable,
            reason,
        ));
    }
    write_run(dir.path(), &info, &all, &summaries);
    dir
}

/// A row measured at so many frames per second; `artifact_px` is `None` where it was not verified.
pub(super) fn paper_row(cell: &Cell, fps: f64, artifact_px: Option<u64>) -> Summary {
    let sample = Sample {
        frame_ms: 1000.0 / fps,
        record_ms: 0.5,
        draw_calls: 12,
        ..Sample::default()
    };
    let wrong = |artifact_px| FrameError {
        artifact_px,
        ..FrameError::default()
    };
    let errors = artifact_px.map_or(Vec::new(), |px| vec![wrong(px), wrong(0)]);
    let status = if artifact_px.is_some() {
        Status::Ok
    } else {
        Status::Unverified
    };
    let samples = [sample.clone(), sample.clone(), sample];
    Summary::from_samples(cell, &samples, &errors, status, "")
}

/// A run of these rows, as read back from a directory of that name.
pub(super) fn paper_run(dir: &str, device: &str, rows: &[Summary]) -> Run {
    let mut info = info(&[], &[]);
    info.device.name = device.to_owned();
    for row in rows {
        let method = MethodRecord {
            id: row.method.clone(),
            variant: row.variant.clone(),
            ..MethodRecord::default()
        };
        if !info.methods.contains(&method) {
            info.methods.push(method);
        }
    }
    Run {
        dir: dir.into(),
        info,
        samples: Vec::new(),
        summaries: rows.to_vec(),
        warnings: Vec::new(),
    }
}
