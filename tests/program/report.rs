//! `svbench report` as its users run it, over run directories; needs no device.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

/// A run from before `scale`, `record_ms_median`, `draw_calls` and `counters` were recorded.
const OLD_RUN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/results/2026-11-22-llvmpipe");
const HOSTILE: &str = "<script>alert(1)</script>";

struct Room(tempfile::TempDir);

impl Room {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// A copy of the old run, with its `run.json` as `change` changes it.
    fn run(&self, name: &str, change: impl Fn(&mut Value)) {
        let dir = self.path(name);
        fs::create_dir(&dir).unwrap();
        for file in ["summary.csv", "samples.csv"] {
            fs::copy(Path::new(OLD_RUN).join(file), dir.join(file)).unwrap();
        }
        let text = fs::read_to_string(Path::new(OLD_RUN).join("run.json")).unwrap();
        let mut info: Value = serde_json::from_str(&text).unwrap();
        change(&mut info);
        fs::write(dir.join("run.json"), info.to_string()).unwrap();
    }

    fn report(&self, args: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_svbench"))
            .arg("report")
            .args(args)
            .current_dir(self.0.path())
            .output()
            .unwrap()
    }

    fn succeed(&self, args: &[&str]) -> String {
        let output = self.report(args);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{args:?}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// The message of a command that must fail with this exit code.
    fn fail(&self, args: &[&str], code: i32) -> String {
        let output = self.report(args);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{args:?}: {errors}");
        errors
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }
}

fn gpu(name: &str) -> impl Fn(&mut Value) {
    move |info| {
        info["device"]["name"] = name.into();
        info["device"]["device_type"] = "discrete_gpu".into();
    }
}

#[test]
fn a_run_from_before_recording_was_measured_has_its_paper_section() {
    let room = Room::new();
    room.run("old", |_| {});
    assert_eq!(room.succeed(&["old"]).trim(), "old/report.html");
    for name in ["table1", "table3", "table4", "ledger"] {
        assert!(!room.read(&format!("old/paper/{name}.csv")).is_empty());
        assert!(!room.read(&format!("old/paper/{name}.md")).is_empty());
    }
    assert!(!room.path("old/paper/table2.csv").exists(), "no cell of it");
    for name in ["figure5", "figure7", "figure8"] {
        assert!(
            room.read(&format!("old/plots/{name}.svg"))
                .contains("R9 280X")
        );
        assert!(room.path(&format!("old/plots/{name}.png")).is_file());
    }
    assert!(!room.path("old/plots/figure6.svg").exists());

    let page = room.read("old/report.html");
    let sections = [
        "Software device",
        "results",
        "paper",
        "ledger",
        "plots",
        "provenance",
    ];
    let places: Vec<usize> = sections
        .iter()
        .map(|name| {
            let heading = format!("<section id=\"{name}\">");
            page.find(&heading).or(page.find(name)).unwrap()
        })
        .collect();
    assert!(places.is_sorted(), "{places:?}");
    assert!(page.contains("its times say nothing about GPUs"));
    // 1 artifact pixel or more on Sponza by every method: marked, none best.
    let table = room.read("old/paper/table4.md");
    assert!(
        table.contains("1.96†") && table.contains("2.44†"),
        "{table}"
    );
}

#[test]
fn a_run_without_a_cell_of_the_paper_has_no_paper_section() {
    let room = Room::new();
    room.run("run", |_| {});
    room.succeed(&["run"]);
    let summary = room.read("run/summary.csv");
    let kept = summary
        .lines()
        .filter(|line| !line.starts_with("sphere") && !line.starts_with("sponza"));
    let kept: String = kept.map(|line| format!("{line}\n")).collect();
    fs::write(room.path("run/summary.csv"), kept).unwrap();
    fs::write(room.path("run/samples.csv"), "").unwrap();
    room.succeed(&["run"]);
    assert!(!room.read("run/report.html").contains("id=\"paper\""));
    assert!(
        !room.path("run/paper/table1.csv").exists(),
        "an earlier report's"
    );
    assert!(
        !room.path("run/plots/figure5.png").exists(),
        "an earlier report's"
    );
}

#[test]
fn runs_of_two_devices_stand_side_by_side() {
    let room = Room::new();
    room.run("a", |_| {});
    room.run("b", gpu("B GPU"));
    let said = room.succeed(&["a", "b", "--out", "both"]);
    assert_eq!(said.trim(), "both/report.html");
    let table = room.read("both/paper/table1.md");
    let head = table.lines().find(|line| line.starts_with('|')).unwrap();
    for device in [
        "R9 280X: ",
        "GTX 680: ",
        "llvmpipe (LLVM 15.0.6, 256 bits): ",
        "B GPU: ",
    ] {
        assert_eq!(head.matches(device).count(), 4, "{head}");
    }
    let ledger = room.read("both/paper/ledger.csv");
    assert_eq!(ledger.matches(",B GPU,false,").count(), 7, "{ledger}");
    let page = room.read("both/report.html");
    assert!(page.contains("B GPU") && page.contains("configs/verify.toml"));
    assert!(!page.contains("Not all runs are complete"));
    let merged: Value = serde_json::from_str(&room.read("both/merged.json")).unwrap();
    assert_eq!(merged["runs"][1]["dir"], "b");
    assert!(
        !room.path("a/report.html").exists(),
        "the runs stay as they are"
    );
}

#[test]
fn a_merged_report_can_be_made_again_and_nothing_else_is_overwritten() {
    let room = Room::new();
    room.run("a", |_| {});
    room.run("b", gpu("B GPU"));
    room.succeed(&["a", "b", "--out", "both"]);
    fs::write(room.path("both/paper/table2.csv"), "an earlier report's").unwrap();
    room.succeed(&["a", "b", "--out", "both"]);
    assert!(!room.path("both/paper/table2.csv").exists());

    fs::create_dir(room.path("mine")).unwrap();
    fs::write(room.path("mine/notes.txt"), "mine").unwrap();
    for out in ["mine", "a"] {
        let error = room.fail(&["a", "b", "--out", out], 1);
        assert!(error.contains(&format!("{out} is not empty")), "{error}");
        assert!(error.contains("--out"), "{error}");
    }
    assert_eq!(fs::read_dir(room.path("mine")).unwrap().count(), 1);
    let error = room.fail(&["a", "b", "--out", "mine/notes.txt"], 1);
    assert!(error.contains("is not a directory"), "{error}");
}

#[test]
fn several_runs_need_a_place_and_must_be_different() {
    let room = Room::new();
    room.run("a", |_| {});
    room.run("b", gpu("B GPU"));
    let error = room.fail(&["a", "b"], 2);
    assert!(
        error.contains("2 runs") && error.contains("--out"),
        "{error}"
    );
    let error = room.fail(&["a", "b", "./a/../a", "--out", "out"], 1);
    assert!(error.contains("is given twice"), "{error}");
    let error = room.fail(&["a", "none", "--out", "out"], 1);
    assert!(error.contains("none is not a run directory"), "{error}");
    let error = room.fail(&["a", "--force"], 2);
    assert!(error.contains("--out"), "{error}");
    assert!(!room.path("out").exists());
}

#[test]
fn runs_that_cannot_be_compared_are_refused_or_shown_apart() {
    let room = Room::new();
    room.run("a", |_| {});
    room.run("b", |info| {
        info["frames"] = 2.into();
        info["scale"] = "small".into();
    });
    let error = room.fail(&["a", "b", "--out", "out"], 1);
    for part in [
        "a and b",
        "frames: 4 and 2",
        "scale: full and small",
        "--force",
    ] {
        assert!(error.contains(part), "{part}: {error}");
    }
    assert!(!room.path("out").exists());
    room.succeed(&["a", "b", "--out", "out", "--force"]);
    let table = room.read("out/paper/table1.md");
    for label in [
        "256 bits) (4 frames, scale full): ",
        "256 bits) (2 frames, scale small): ",
    ] {
        assert!(table.contains(label), "{label}: {table}");
    }
}

#[test]
fn an_unfinished_run_is_named_in_a_banner() {
    let room = Room::new();
    room.run("a", |_| {});
    room.run("b", |info| info["status"] = "interrupted".into());
    room.succeed(&["a", "b", "--out", "out"]);
    let page = room.read("out/report.html");
    assert!(page.contains("Not all runs are complete"));
    assert!(
        page.contains("<code>b</code>: This run was interrupted."),
        "{page}"
    );
}

#[test]
fn names_cannot_break_out_of_the_merged_page() {
    let room = Room::new();
    room.run("a", |_| {});
    room.run("b", |info| {
        gpu(HOSTILE)(info);
        info["title"] = HOSTILE.into();
        info["config_path"] = HOSTILE.into();
        info["warnings"] = Value::Array(vec![HOSTILE.into()]);
        info["frames"] = 2.into();
        info["scale"] = HOSTILE.into();
    });
    room.succeed(&["a", "b", "--out", "out", "--force"]);
    let page = room.read("out/report.html");
    assert!(!page.contains("<script"), "not escaped");
    assert!(page.contains("&lt;script&gt;"));
    let table = room.read("out/paper/table1.md");
    assert!(!table.replace("\\<", "").contains("<script"), "{table}");
}

#[test]
fn a_stress_run_is_reported_alone() {
    let room = Room::new();
    room.run("run", |_| {});
    fs::create_dir(room.path("stress")).unwrap();
    let head = r#"{"format": 1, "complete": true, "title": "", "program_version": "1", "program_git": "",
        "started": "", "duration_s": 1, "command": [], "seed": 7, "width": 8, "height": 6,
        "device": {"name": "", "vendor_id": 0, "device_type": "", "driver": "", "driver_info": "",
            "backend": "", "tessellation": true, "geometry": true},
        "host": {"os": "", "arch": "", "cores": 1}, "shader_hash": "", "config_path": "", "config_text": "",
        "causes": [{"id": "fan", "title": "Pages", "number": "pages", "why": "", "values": [3]}],
        "methods": [{"id": "shadow_map", "variant": "", "tolerated_share": 0}]}"#;
    fs::write(room.path("stress/stability.json"), head).unwrap();
    let rows = "cause,value,method,variant,outcome,artifact_px,boundary_px,false_lit,false_shadowed,\
        ambiguous_px,kinds,reason,picture\nfan,3,shadow_map,,undeclared,5,0,5,0,0,,,\n";
    fs::write(room.path("stress/stability.csv"), rows).unwrap();
    assert_eq!(room.succeed(&["stress"]).trim(), "stress/report.html");
    assert!(room.read("stress/matrix.md").contains("**3!** (5 px)"));

    for args in [
        &["run", "stress", "--out", "both"][..],
        &["run", "stress"],
        &["stress", "--out", "both"],
    ] {
        let message = room.fail(args, 2);
        assert!(message.contains("stress holds a stress run"), "{message}");
    }
    fs::copy(room.path("run/run.json"), room.path("stress/run.json")).unwrap();
    assert!(room.fail(&["stress"], 2).contains("has both"));
}
