//! What exceeds the device, a device that is lost, and scenes that cannot be drawn: the cells concerned get the
//! reason, the others go on, and the exit code is 1.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

type Row = HashMap<String, String>;

/// A folder to work in, with a configuration.
struct Workplace {
    dir: tempfile::TempDir,
}

impl Workplace {
    fn new(config: &str) -> Self {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("config.toml"), config).unwrap();
        Self { dir }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    fn svbench(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_svbench"));
        command.args(args).env("SVBENCH_CACHE", "");
        command.current_dir(self.dir.path());
        command
    }

    /// Runs the configuration, whose device is lost at some frames; gives the rows of the summary.
    fn run(&self, lost_at: &str) -> (Output, Vec<Row>) {
        let out = self.path("run");
        if out.exists() {
            std::fs::remove_dir_all(&out).unwrap();
        }
        let output = self
            .svbench(&["run", "config.toml", "--out", "run"])
            .env("SVBENCH_TEST_LOSE_DEVICE", lost_at)
            .output()
            .unwrap();
        let errors = words(&output);
        assert!(out.join("summary.csv").exists(), "{errors}");
        (output, rows(&out.join("summary.csv")))
    }
}

fn rows(path: &Path) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().map(Result::unwrap).collect()
}

fn words(output: &Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!errors.contains("panicked"), "{errors}");
    errors
}

fn assert_failed(output: &Output) -> String {
    let errors = words(output);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    errors
}

fn status_of<'a>(rows: &'a [Row], scene: &str, method: &str) -> (&'a str, &'a str) {
    let is_it = |row: &&Row| row["scene"] == scene && row["method"] == method;
    let row = rows.iter().find(is_it).unwrap();
    (&row["status"], &row["reason"])
}

const SETTINGS: &str = "title = \"Test\"\nsize = [64, 48]\nframes = 3\nwarmup_frames = 1\nverified_frames = 2\n\
    seed = 7\n";
const GRID: &str = "[[scenes]]\nscene = \"sphere_grid\"\nslices = 8\n";
const METHODS: &str = "[[methods]]\nid = \"silhouette_gs\"\n[[methods]]\nid = \"shadow_map\"\nresolution = 256\n\
    [[methods]]\nid = \"triangle_ts\"\n";

#[test]
fn a_map_larger_than_the_device_fails_its_cell_alone() {
    for resolution in [10_000, 65_536] {
        let methods = format!("[[methods]]\nid = \"cube_shadow_map\"\nresolution = {resolution}\n");
        let place = Workplace::new(&[SETTINGS, GRID, METHODS, &methods].concat());
        let (output, rows) = place.run("");
        let (status, reason) = status_of(&rows, "sphere_grid_n8", "cube_shadow_map");
        if status == "ok" && resolution == 10_000 {
            // A device with so much memory.
            continue;
        }
        assert_failed(&output);
        assert_eq!(status, "failed");
        assert!(reason.contains(&resolution.to_string()), "{reason}");
        for method in ["silhouette_gs", "shadow_map", "triangle_ts"] {
            assert_eq!(status_of(&rows, "sphere_grid_n8", method), ("ok", ""));
        }
    }
}

#[test]
fn a_scene_larger_than_the_device_or_the_memory_fails_alone() {
    // 12 million triangles: more than 128 MiB of indices. 1.3 thousand million: more than memory.
    let large = |rows: u32, slices: u32| {
        format!(
            "[[scenes]]\nscene = \"sphere_grid\"\nrows = {rows}\ncolumns = 1\nslices = {slices}\n"
        )
    };
    let scenes = [&large(1, 3466), GRID, &large(340, 2000)].concat();
    let place = Workplace::new(&[SETTINGS, &scenes, METHODS].concat());
    let (output, rows) = place.run("");
    assert_failed(&output);
    let failed: Vec<_> = rows
        .iter()
        .filter(|row| row["status"] == "failed")
        .collect();
    assert!(failed.iter().all(|row| row["scene"] != "sphere_grid_n8"));
    for row in failed {
        let reason = &row["reason"];
        assert!(
            reason.contains("triangles") && reason.contains("iB"),
            "{reason}"
        );
    }
    let own = rows.iter().filter(|row| row["scene"] == "sphere_grid_n8");
    assert!(own.clone().count() == 3 && own.into_iter().all(|row| row["status"] == "ok"));
}

#[test]
fn a_picture_larger_than_memory_is_refused_in_words() {
    let place = Workplace::new("");
    let args = [
        "render",
        "sphere_grid",
        "--method",
        "shadow_map,resolution=256",
    ];
    // So much address space holds the program and its device, but no picture of 16384 × 16384.
    let program = place.svbench(&args);
    let mut line = Command::new("sh");
    line.args([
        "-c",
        "ulimit -v 4000000; exec \"$0\" \"$@\" --size 16384x16384",
    ]);
    line.arg(program.get_program()).args(program.get_args());
    let output = line.env("SVBENCH_CACHE", "").output().unwrap();
    let errors = assert_failed(&output);
    assert!(
        errors.contains("16384") && errors.contains("GiB"),
        "{errors}"
    );
}

#[test]
fn a_lost_device_fails_one_cell_and_is_opened_again() {
    let place = Workplace::new(&[SETTINGS, GRID, METHODS].concat());
    let (output, rows) = place.run("");
    assert!(output.status.success(), "{}", words(&output));
    assert_eq!(rows.len(), 3);
    // Frames of the truth, of verification, of warming up and of the measurement.
    let mut failures = Vec::new();
    for lost_at in 1..=20 {
        let (output, rows) = place.run(&lost_at.to_string());
        let errors = words(&output);
        let failed: Vec<_> = rows
            .iter()
            .filter(|row| row["status"] == "failed")
            .collect();
        assert!(!failed.is_empty(), "{lost_at}: {errors}");
        assert_eq!(output.status.code(), Some(1), "{lost_at}: {errors}");
        for row in &failed {
            assert!(row["reason"].contains("the device was lost"), "{row:?}");
        }
        let ok = rows.iter().filter(|row| row["status"] == "ok");
        assert!(
            ok.clone().all(|row| row["frames"] == "3"),
            "{lost_at}: {rows:?}"
        );
        assert_eq!(ok.count() + failed.len(), 3, "{lost_at}: {rows:?}");
        // What is kept is whole, and no frame is measured twice.
        let samples = crate::device::rows(&place.path("run/samples.csv"));
        let frames: std::collections::HashSet<_> = samples
            .iter()
            .map(|row| (row["method"].clone(), row["frame"].clone()))
            .collect();
        assert_eq!(frames.len(), samples.len(), "{lost_at}");
        failures.push(failed.len());
    }
    // The truth is everybody's, so its frame brings all down; any other frame one cell.
    assert!(
        failures.iter().all(|cells| [1, 3].contains(cells)),
        "{failures:?}"
    );
    assert!(
        failures.iter().filter(|cells| **cells == 1).count() > 12,
        "{failures:?}"
    );
}

#[test]
fn every_loss_costs_one_cell_until_none_is_left() {
    let place = Workplace::new(&[SETTINGS, GRID, METHODS].concat());
    let every: Vec<_> = (3..200).step_by(4).map(|n: u32| n.to_string()).collect();
    let (output, rows) = place.run(&every.join(","));
    assert_failed(&output);
    assert!(rows.iter().any(|row| row["status"] == "failed"), "{rows:?}");
}

#[test]
fn commands_of_single_pictures_say_that_the_device_was_lost() {
    let place = Workplace::new("");
    let method = [
        "--method",
        "silhouette_gs",
        "--method",
        "triangle_ts",
        "--size",
        "64x48",
    ];
    let lose = |args: &[&str], lost_at: u32| {
        let output = place
            .svbench(args)
            .env("SVBENCH_TEST_LOSE_DEVICE", lost_at.to_string())
            .output()
            .unwrap();
        let errors = assert_failed(&output);
        errors + &String::from_utf8_lossy(&output.stdout)
    };
    let one = [
        "sphere_grid",
        "--method",
        "triangle_gs,front_cap=in_place",
        "--size",
        "64x48",
    ];
    for command in ["render", "minimise"] {
        let args = [&[command], &one[..]].concat();
        for lost_at in 1..=3 {
            let text = lose(&args, lost_at);
            assert!(
                text.contains("the device was lost"),
                "{command} {lost_at}: {text}"
            );
        }
    }
    for lost_at in [1, 2, 5, 6] {
        let args = [&["fuzz", "--cases", "3"], &method[..]].concat();
        let text = lose(&args, lost_at);
        assert!(
            text.contains("the device was lost"),
            "fuzz {lost_at}: {text}"
        );
        let args = [&["metamorphic", "sphere_grid", "--soups", "0"], &method[..]].concat();
        let text = lose(&args, lost_at);
        assert!(
            text.contains("the device was lost"),
            "metamorphic {lost_at}: {text}"
        );
        let out = format!("stress{lost_at}");
        let args = [&["stress", "--cause", "fan", "--out", &out], &method[..]].concat();
        lose(&args, lost_at);
        let rows = rows(&place.path(&out).join("stability.csv"));
        let failed: Vec<_> = rows
            .iter()
            .filter(|row| row["outcome"] == "failed")
            .collect();
        assert!((1..=2).contains(&failed.len()), "{lost_at}: {rows:?}");
        assert!(
            failed[0]["reason"].contains("the device was lost"),
            "{failed:?}"
        );
        assert!(rows.len() > 4, "the sweep goes on: {rows:?}");
    }
}

/// A scene file with a triangle over another, seen on a flight.
fn scene(model: &str, keys: &str) -> String {
    format!(
        "title = \"t\"\n[mesh]\nkind = \"obj\"\nfile = \"{model}\"\nup = \"y\"\n[light]\nposition = [0.3, 8.0, 0.2]\n\
         [camera]\nfov_deg = 45.0\nnear = 0.1\nkeys = [{keys}]\n"
    )
}

const MODEL: &str =
    "v -9 0 -9\nv 9 0 -9\nv 0 0 9\nv -1 1 -1\nv 1 1 -1\nv 0 1 1\nf 1 2 3\nf 4 5 6\n";

fn key(time_s: f64, eye: &str, target: &str) -> String {
    format!("{{ time_s = {time_s:?}, eye = {eye}, target = {target} }},")
}

#[test]
fn scenes_that_cannot_be_drawn_fail_with_time_and_cause_and_the_others_go_on() {
    let scenes = ["bad_model", "through_target", "too_far", "good"]
        .map(|name| format!("[[scenes]]\nscene = \"{name}.toml\"\n"))
        .concat();
    let place = Workplace::new(&[SETTINGS, &scenes, METHODS].concat());
    place.write("good.obj", MODEL);
    place.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 x 1\nf 1 2 3\n");
    let still = key(0.0, "[3.0, 4.0, 6.0]", "[0.0, 0.0, 0.0]");
    place.write("good.toml", &scene("good.obj", &still));
    place.write("bad_model.toml", &scene("bad.obj", &still));
    // Eye and target change places, and meet half way: the second of three frames has no picture.
    let crossing = key(0.0, "[0.0, 2.0, 6.0]", "[0.0, 2.0, 0.0]")
        + &key(2.0, "[0.0, 2.0, 0.0]", "[0.0, 2.0, 6.0]");
    place.write("through_target.toml", &scene("good.obj", &crossing));
    // Good keys, beyond the last but one of which the spline runs out of numbers.
    let far = key(0.0, "[-1.35e38, 2.0, 6.0]", "[-1.35e38, 2.0, 0.0]")
        + &key(1.0, "[1.35e38, 2.0, 6.0]", "[1.35e38, 2.0, 0.0]")
        + &key(2.0, "[1.35e38, 2.0, 6.0]", "[1.35e38, 2.0, 0.0]");
    place.write("too_far.toml", &scene("good.obj", &far));
    let (output, rows) = place.run("");
    assert_failed(&output);
    assert_eq!(rows.len(), 12);
    for method in ["silhouette_gs", "shadow_map", "triangle_ts"] {
        assert_eq!(status_of(&rows, "good", method), ("ok", ""));
        let (status, reason) = status_of(&rows, "bad_model", method);
        assert!(status == "failed" && reason.contains("bad.obj"), "{reason}");
        let (status, reason) = status_of(&rows, "through_target", method);
        let expected =
            "no picture at 1 s of the flight: camera: the camera looks at the point where it is";
        assert!(status == "failed" && reason.contains(expected), "{reason}");
        let (status, reason) = status_of(&rows, "too_far", method);
        let expected =
            "no picture at 1.5 s of the flight: camera: the camera's numbers are too large";
        assert!(status == "failed" && reason.contains(expected), "{reason}");
    }
    let samples = crate::device::rows(&place.path("run/samples.csv"));
    assert!(
        samples.iter().all(|row| row["scene"] == "good"),
        "nothing else is measured"
    );
    let report = place.svbench(&["report", "run"]).output().unwrap();
    assert!(report.status.success(), "{}", words(&report));
}

#[test]
fn a_camera_without_a_picture_is_refused() {
    let place = Workplace::new("");
    let refused = |args: &[&str], expected: &str| {
        let shot = [
            "render",
            "sphere_grid",
            "--method",
            "shadow_map,resolution=64",
            "--size",
            "8x8",
        ];
        let output = place.svbench(&[&shot, args].concat()).output().unwrap();
        let errors = words(&output);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {errors}");
        assert!(errors.contains(expected), "{args:?}: {errors}");
    };
    refused(&["--eye", "nan,0,0"], "nan");
    refused(&["--eye", "inf,0,0"], "inf");
    refused(
        &["--eye", "1,2,3", "--target", "1,2,3"],
        "the point where it is",
    );
    refused(
        &["--eye", "0,5,0", "--target", "0,0,0"],
        "along its up direction",
    );
    refused(&["--up", "0,0,0"], "up");
    refused(&["--fov", "0"], "above 0 and below 180");
    refused(&["--fov", "180"], "above 0 and below 180");
    refused(&["--near", "0"], "farther away than 0");
    refused(&["--near", "-1"], "farther away than 0");
    refused(
        &["--eye", "3e38,0,0", "--target", "-3e38,0,0"],
        "too large or too small",
    );
}
