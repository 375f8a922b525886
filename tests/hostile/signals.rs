//! Being asked to stop: by Ctrl-C, by a batch queue, by a terminal that closes; and under `nohup`.

use crate::room::{CONFIG, Room, ends, wait_until};
use std::process::{Child, Command, Output, Stdio};

/// A run that nobody waits for.
fn endless() -> Room {
    let room = Room::new();
    room.write(
        "config.toml",
        CONFIG.replace("frames = 3", "frames = 1000000"),
    );
    room.write(
        "stress.toml",
        "title = \"t\"\nsize = [320, 240]\n[[methods]]\nid = \"shadow_map\"\nresolution = [256, 512, 1024, 2048, 4096]\n",
    );
    room
}

fn start(command: &mut Command) -> Child {
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().unwrap()
}

fn send(child: &Child, signal: &str) {
    let mut kill = Command::new("kill");
    kill.args([&format!("-{signal}"), &child.id().to_string()]);
    assert!(kill.status().unwrap().success());
}

fn end(child: Child, what: &str) -> Output {
    let output = child.wait_with_output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(!errors.contains("panicked"), "{what}: {errors}");
    assert_eq!(output.status.code(), Some(1), "{what}: {errors}");
    assert!(errors.contains("interrupted"), "{what}: {errors}");
    output
}

#[test]
fn a_run_that_is_asked_to_stop_keeps_what_it_has() {
    for signal in ["INT", "TERM", "HUP"] {
        let room = endless();
        let samples = room.path("run/samples.csv");
        let mut run = start(&mut room.svbench(["run", "config.toml", "--out", "run"]));
        wait_until(&mut run, || {
            std::fs::read(&samples).is_ok_and(|rows| rows.len() > 1000)
        });
        send(&run, signal);
        end(run, signal);
        assert_eq!(
            room.json("run/run.json")["status"],
            "interrupted",
            "{signal}"
        );
        assert!(room.path("run/report.html").is_file(), "{signal}");
        ends(&mut room.svbench(["report", "run"]), 0);
    }
}

#[test]
fn a_signal_that_comes_twice_is_no_second_thought() {
    let room = endless();
    let samples = room.path("run/samples.csv");
    let mut run = start(&mut room.svbench(["run", "config.toml", "--out", "run"]));
    wait_until(&mut run, || {
        std::fs::read(&samples).is_ok_and(|rows| rows.len() > 1000)
    });
    for signal in ["TERM", "HUP", "TERM"] {
        send(&run, signal);
    }
    end(run, "TERM, HUP, TERM");
    assert_eq!(room.json("run/run.json")["status"], "interrupted");
}

#[test]
fn under_nohup_a_run_outlives_its_terminal() {
    let room = Room::furnished();
    room.write("config.toml", CONFIG.replace("frames = 3", "frames = 200"));
    let line = "trap '' HUP; exec $svbench run config.toml --out run";
    let samples = room.path("run/samples.csv");
    let mut run = start(&mut room.shell(line));
    wait_until(&mut run, || {
        std::fs::read(&samples).is_ok_and(|rows| rows.len() > 1000)
    });
    send(&run, "HUP");
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert_eq!(room.json("run/run.json")["status"], "complete");
}

#[test]
fn every_command_that_takes_long_can_be_asked_to_stop() {
    let commands: [&[&str]; 5] = [
        &["stress", "stress.toml", "--out", "stress"],
        &["fuzz", "--cases", "1000000", "--size", "64x48"],
        &[
            "metamorphic",
            "sphere_grid",
            "--soups",
            "1000000",
            "--size",
            "64x48",
        ],
        &["accuracy", "config.toml", "--out", "accuracy"],
        &[
            "minimise",
            "sphere_grid",
            "--method",
            "shadow_map,resolution=16",
            "--seconds",
            "3600",
            "--out",
            "left",
        ],
    ];
    for command in commands {
        let room = endless();
        let mut child = start(room.svbench(command).env("TERM", "dumb"));
        // The first line of progress says that it listens.
        let errors = child.stderr.take().unwrap();
        let mut lines = std::io::BufRead::lines(std::io::BufReader::new(errors));
        let first = lines.next().unwrap().unwrap();
        assert!(first.starts_with('['), "{command:?}: {first}");
        send(&child, "TERM");
        let errors: Vec<String> = lines.map(Result::unwrap).collect();
        let status = child.wait().unwrap();
        assert_eq!(status.code(), Some(1), "{command:?}: {errors:?}");
        let told = errors.iter().any(|line| line.contains("interrupted"));
        assert!(told, "{command:?}: {errors:?}");
    }
}
