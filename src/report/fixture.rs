//! Made-up run directories for the tests of the outputs.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::{LegendEntry, Run};
use crate::record::{
    BIAS_FILE, BiasRow, Cell, DeviceRecord, FORMAT, HostRecord, METRICS_FILE, MethodRecord,
    REGIONS_FILE, RUN_FILE, RegionRow, RunInfo, RunStatus, SAMPLES_FILE, STAGES_FILE, SUMMARY_FILE,
    Sample, SceneRecord, StageMs, Status, Summary, SweepRecord, VerifiedFrame, metric_rows,
    stage_rows,
};
use serde::Serialize;

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
        size_px: None,
        name: (*name).to_owned(),
        title: String::new(),
        triangles: Some(1000),
        objects: Some(4),
        mesh_hash: "0123".to_owned(),
        light: [3.0, 20.0, 5.0],
        light_w: 1.0,
        light_moves: false,
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
        lead_in: 0,
        verified_frames: 2,
        scenes: scenes.iter().map(scene).collect(),
        methods: methods.iter().map(method).collect(),
        shader_hash: "feed".to_owned(),
        config_path: "made_up.toml".to_owned(),
        config_text: "seed = 7".to_owned(),
        ..RunInfo::default()
    }
}

pub(super) fn cell(info: &RunInfo, scene: &str, method: &str, triangles: u64) -> Cell {
    Cell {
        scene: scene.to_owned(),
        triangles: Some(triangles),
        objects: Some(4),
        method: method.to_owned(),
        variant: Default::default(),
        width: info.width,
        height: info.height,
        counters: Vec::new(),
    }
}

pub(super) fn samples(cell: &Cell, shadow_ms: f64) -> Vec<Sample> {
    let stage = |(stage, device_ms): (&str, f64)| StageMs {
        stage: stage.to_owned(),
        device_ms,
        cpu_ms: 0.0,
    };
    let sample = |frame: u32| Sample {
        scene: cell.scene.clone(),
        triangles: cell.triangles.unwrap(),
        objects: cell.objects.unwrap(),
        method: cell.method.clone(),
        variant: cell.variant.clone(),
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
        stages: [("volumes", 1.5), ("resolve", 0.25)].map(stage).to_vec(),
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
    write_rows(dir, SAMPLES_FILE, samples);
    write_rows(dir, STAGES_FILE, &stage_rows(samples));
    write_rows(dir, SUMMARY_FILE, summaries);
}

pub(super) fn write_rows<T: Serialize>(dir: &Path, file: &str, rows: &[T]) {
    let mut writer = csv::Writer::from_path(dir.join(file)).unwrap();
    rows.iter().for_each(|row| writer.serialize(row).unwrap());
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
            let errors = [
                counted(artifact_px + 3, 0, 3, artifact_px, 17),
                counted(0, 0, 0, 0, 0),
            ];
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
    let wrong = |artifact_px| counted(0, 0, 0, artifact_px, 0);
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
        frames: Vec::new(),
        regions: Vec::new(),
        biases: Vec::new(),
        warnings: Vec::new(),
    }
}

/// What [`swept_run`] compares: eight exact or nearly exact methods, then two sweeps of five.
const PLAIN: [(&str, &str, f64, u64); 8] = [
    ("silhouette_ts", "", 1.9, 0),
    ("silhouette_ts", "determinism=consistent_triangle", 2.1, 0),
    ("silhouette_gs", "", 2.6, 0),
    ("triangle_gs", "counting=z_pass", 4.4, 12),
    ("triangle_ts", "", 5.5, 0),
    ("silhouette_cs", "caps=off", 1.5, 3),
    ("ray_query", "", 3.2, 0),
    ("alias_free_map", "", 2.9, 1),
];
const SWEPT: [(&str, &str, &str); 2] = [
    ("shadow_map", "", "resolution"),
    ("cube_shadow_map", "slope_bias=2", "pcf"),
];

/// Eighteen contenders in three scenes, with all that verification can leave behind.
pub(super) fn swept_run() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    let mut info = info(&["grid_n10", "grid_n20", "sponza"], &[]);
    let mut contenders: Vec<(MethodRecord, f64, u64)> = Vec::new();
    for (id, variant, shadow_ms, wrong_px) in PLAIN {
        contenders.push((record(id, variant, None), shadow_ms, wrong_px));
    }
    for (id, curve, parameter) in SWEPT {
        for step in 0..5_u32 {
            let value = if parameter == "pcf" {
                2 * step + 1
            } else {
                512 << step
            };
            let sweep = SweepRecord {
                curve: curve.parse().unwrap(),
                parameter: parameter.to_owned(),
                value: f64::from(value),
            };
            let variant = format!("{curve},{parameter}={value}");
            let record = record(id, variant.trim_start_matches(','), Some(sweep));
            let shadow_ms = 0.3 * 1.7_f64.powi(step as i32) * (2.0 - 1.0 / id.len() as f64);
            contenders.push((record, shadow_ms, 9000 >> (2 * step)));
        }
    }
    info.methods = contenders
        .iter()
        .map(|(record, ..)| record.clone())
        .collect();
    let (mut all, mut summaries, mut errors) = (Vec::new(), Vec::new(), Vec::new());
    for (place, scene) in ["grid_n10", "grid_n20", "sponza"].into_iter().enumerate() {
        for (method, shadow_ms, wrong_px) in &contenders {
            let cell = Cell {
                variant: method.variant.clone(),
                ..cell(&info, scene, &method.id, 1000 << (2 * place))
            };
            let own = samples(&cell, shadow_ms * (1.0 + place as f64));
            let wrong =
                [0, 1].map(|frame| frame_error(&cell, frame, wrong_px * (place as u64 + 1)));
            let row = Summary::from_samples(&cell, &own, &wrong, Status::Ok, "");
            summaries.push(row);
            all.extend(own);
            errors.extend(wrong);
        }
    }
    write_run(dir.path(), &info, &all, &summaries);
    write_rows(dir.path(), METRICS_FILE, &metric_rows(&errors));
    let region = RegionRow {
        scene: "sponza".to_owned(),
        method: "shadow_map".to_owned(),
        variant: "resolution=512".parse().unwrap(),
        frame: 1,
        sign: "false_lit".to_owned(),
        label: "leak".to_owned(),
        size_px: 1234,
        left: 10,
        top: 20,
        right: 40,
        bottom: 90,
    };
    write_rows(dir.path(), REGIONS_FILE, &[region]);
    let bias = BiasRow {
        scene: "sponza".to_owned(),
        method: "shadow_map".to_owned(),
        variant: "slope_bias=search".parse().unwrap(),
        resolution: 2048,
        slope_bias: 2.25,
        acne_px_unbiased: 4321.5,
        acne_px: 0.0,
        detached_px_unbiased: 1.5,
        detached_px: 77.25,
        tried: 9,
    };
    write_rows(dir.path(), BIAS_FILE, &[bias]);
    dir
}

fn record(id: &str, variant: &str, sweep: Option<SweepRecord>) -> MethodRecord {
    MethodRecord {
        id: id.to_owned(),
        variant: variant.parse().unwrap(),
        sweep,
        ..MethodRecord::default()
    }
}

/// A frame with about so many wrong pixels, more of them in later frames.
fn frame_error(cell: &Cell, frame: u32, wrong_px: u64) -> VerifiedFrame {
    let wrong_px = wrong_px * (10 + u64::from(frame)) / 10;
    let far_px = wrong_px / 4;
    let near_px = wrong_px - far_px;
    let found = [
        ("distance.1", near_px),
        ("distance.4", far_px),
        ("distance.more", 0),
        ("regions", u64::from(far_px > 0) * 3),
        ("label.acne", far_px),
        ("label.leak", wrong_px / 9),
        ("followed_px", 1_000_000),
        ("flicker_px", wrong_px / 10),
    ];
    let found = found.map(|(name, value)| (name.to_owned(), value as f64));
    let far = (wrong_px > 0).then(|| ("distance_px_max".to_owned(), 3.5));
    let counts = counted(wrong_px - wrong_px / 3, wrong_px / 3, near_px, far_px, 0);
    let counts = counts
        .metrics
        .iter()
        .map(|(name, value)| (name.to_owned(), value));
    let all = counts.chain(found).chain(far);
    VerifiedFrame {
        metrics: all.chain([("flip".to_owned(), 0.0125)]).collect(),
        ..VerifiedFrame::of(cell, frame, 0.0)
    }
}

/// A frame with these counts.
pub(super) fn counted(
    false_lit: u64,
    false_shadowed: u64,
    boundary_px: u64,
    artifact_px: u64,
    ambiguous_px: u64,
) -> VerifiedFrame {
    let counts = [
        ("false_lit", false_lit),
        ("false_shadowed", false_shadowed),
        ("boundary_px", boundary_px),
        ("artifact_px", artifact_px),
        ("ambiguous_px", ambiguous_px),
    ];
    VerifiedFrame {
        metrics: counts
            .map(|(name, px)| (name, px as f64))
            .into_iter()
            .collect(),
        ..VerifiedFrame::default()
    }
}
