//! No device, no validation layers, no terminal to speak of; and two runs in one second.

use crate::room::{Room, ends};
use std::process::Command;

#[test]
fn a_machine_without_a_device_says_what_to_install() {
    let room = Room::furnished();
    let without = |args: &[&str]| {
        let mut command = room.svbench(args);
        command.env("VK_DRIVER_FILES", "/nowhere.json");
        command.env("VK_ICD_FILENAMES", "/nowhere.json");
        command
    };
    let (text, _) = ends(&mut without(&["list", "devices"]), 0);
    assert!(
        text.contains("no graphics device found") && text.contains("install"),
        "{text}"
    );
    let (json, errors) = ends(&mut without(&["list", "devices", "--json"]), 0);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["devices"], serde_json::json!([]));
    assert!(errors.contains("no graphics device found"), "{errors}");
    let (text, _) = ends(&mut without(&["list"]), 0);
    assert!(
        text.contains("silhouette_gs") && text.contains("no graphics device found"),
        "{text}"
    );
    let (_, errors) = ends(&mut without(&["run", "config.toml", "--out", "run"]), 1);
    assert!(errors.contains("no graphics device found"), "{errors}");
    assert!(!room.path("run").exists());
}

#[test]
fn validation_that_cannot_be_is_refused() {
    let room = Room::furnished();
    std::fs::create_dir(room.path("no layers")).unwrap();
    for args in [
        &["run", "config.toml", "--out", "run", "--validation"][..],
        &[
            "render",
            "scene.toml",
            "--method",
            "shadow_map",
            "--validation",
        ],
        &["fuzz", "--cases", "1", "--validation"],
    ] {
        let mut command = room.svbench(args);
        command.env("VK_LAYER_PATH", room.path("no layers"));
        command.env_remove("VK_ADD_LAYER_PATH");
        let (_, errors) = ends(&mut command, 1);
        assert!(errors.contains("vulkan-validationlayers"), "{errors}");
    }
    assert!(!room.path("run").exists());
}

#[test]
fn runs_within_a_second_have_names_of_their_own() {
    let room = Room::furnished();
    let line = "for i in 1 2 3; do $svbench run config.toml --frames 1 & done; wait";
    ends(&mut room.shell(line), 0);
    let runs: Vec<_> = room
        .path("results")
        .read_dir()
        .unwrap()
        .map(Result::unwrap)
        .collect();
    assert_eq!(runs.len(), 3, "{runs:?}");
    for run in runs {
        let info = std::fs::read_to_string(run.path().join("run.json")).unwrap();
        assert!(info.contains("\"complete\""), "{info}");
    }
}

#[test]
fn a_terminal_that_cannot_draw_gets_lines() {
    let room = Room::furnished();
    for (i, term) in ["TERM=dumb", "TERM=", "-u TERM"].iter().enumerate() {
        // `script` runs the program on a terminal of its own.
        let line = format!(
            "env {term} {} run config.toml --out run{i}",
            env!("CARGO_BIN_EXE_svbench")
        );
        let mut script = Command::new("script");
        script.args(["-qec", &line, "/dev/null"]);
        script.env("SVBENCH_CACHE", "").current_dir(room.path(""));
        let Ok(output) = script.output() else {
            return;
        };
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{text}");
        assert!(text.contains("s] 0/"), "{term}: {text}");
    }
}
