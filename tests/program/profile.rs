//! `svbench profile`, as its users run it.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::HashMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A tower, 2 × 3 × 2, whose bottom is open.
const TOWER: &str = "o tower
v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1
v -1 3 -1\nv 1 3 -1\nv 1 3 1\nv -1 3 1
f 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\nf 5 8 7 6
";

const SCENE: &str = r#"title = "Tower"
[mesh]
kind = "obj"
file = "tower.obj"
up = "y"
ground = { height = 0.0, reach = 30.0 }
[light.sun]
latitude = 48.2
longitude = 16.37
date = "2026-09-18"
zone = "Europe/Vienna"
from = "09:00"
to = "17:00"
duration_s = 4.0
[camera]
fov_deg = 50.0
near = 0.1
keys = [{ time_s = 0.0, eye = [4.0, 14.0, 13.0], target = [0.0, 0.0, -2.0] }]
"#;

fn room() -> tempfile::TempDir {
    let room = tempfile::tempdir().unwrap();
    fs::write(room.path().join("tower.obj"), TOWER).unwrap();
    fs::write(room.path().join("tower.toml"), SCENE).unwrap();
    fs::write(
        room.path().join("lamp.toml"),
        SCENE.split("[light.sun]").next().unwrap().to_owned()
            + "[light]\nposition = [3, 9, 2]\n[camera]"
            + SCENE.split("[camera]").nth(1).unwrap(),
    )
    .unwrap();
    room
}

fn profile(room: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_svbench"))
        .args(["profile", "--size=160x120"])
        .args(args)
        .current_dir(room)
        .env("SVBENCH_CACHE", "")
        .output()
        .unwrap()
}

fn rows(path: &Path) -> Vec<HashMap<String, String>> {
    let rows = csv::Reader::from_path(path).unwrap().into_deserialize();
    rows.map(Result::unwrap).collect()
}

fn number(row: &HashMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap()
}

fn frames(path: &Path) -> (u32, Vec<Vec<u8>>) {
    let file = std::io::BufReader::new(fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let info = reader.info();
    let width = info.width;
    let count = info
        .animation_control
        .map_or(1, |control| control.num_frames);
    let bytes = reader.output_buffer_size().unwrap();
    let frame = |_| {
        let mut pixels = vec![0; bytes];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    };
    (width, (0..count).map(frame).collect())
}

#[test]
fn a_day_leaves_its_pictures_and_hours_and_methods_agree() {
    let room = room();
    let methods = [
        "silhouette_ts",
        "silhouette_gs",
        "triangle_ts",
        "triangle_gs",
    ];
    let mut args = vec![
        "tower.toml",
        "--from=05:00",
        "--to=20:00",
        "--step=1h",
        "--per-triangle",
    ];
    args.extend(["--validation", "--method=cube_shadow_map"]);
    let named = methods.map(|method| format!("--method={method}"));
    args.extend(named.iter().map(String::as_str));
    for out in ["one", "two"] {
        let said = profile(room.path(), &[&args[..], &["--out", out]].concat());
        let errors = String::from_utf8_lossy(&said.stderr);
        assert!(said.status.success(), "{errors}");
        let text = String::from_utf8_lossy(&said.stdout);
        assert!(text.contains("16 steps, the sun is up at 12"), "{text}");
    }
    let one = |name: &str| room.path().join("one").join(name);
    // All that is measured is the same each time.
    let tables = ["hours.csv", "methods.csv", "triangles.csv", "triangles.ply"];
    for name in tables
        .into_iter()
        .chain(["overlay.png", "hours.png", "day.png"])
    {
        let other = fs::read(room.path().join("two").join(name)).unwrap();
        assert_eq!(fs::read(one(name)).unwrap(), other, "{name}");
    }
    for name in ["overlay.png", "hours.png", "hours-silhouette_ts.png"] {
        assert_eq!(frames(&one(name)).0, 160, "{name}");
    }
    let (_, film) = frames(&one("day.png"));
    assert_eq!(film.len(), 16);
    assert!(
        film.windows(2).all(|pair| pair[0] != pair[1]),
        "each frame has its time"
    );

    let steps = rows(&one("hours.csv"));
    let minutes: f64 = steps.iter().map(|row| number(row, "minutes")).sum();
    assert_eq!(minutes, 15.0 * 60.0);
    assert_eq!(
        (&*steps[0]["local_time"], &*steps[0]["lit_px"]),
        ("05:00", "0")
    );
    let noon = &steps[8];
    assert!(
        (number(noon, "sun_azimuth_deg") - 180.0).abs() < 10.0,
        "{noon:?}"
    );
    assert!(number(noon, "lit_share") > number(&steps[3], "lit_share"));

    let rows = rows(&one("methods.csv"));
    assert_eq!(
        (&*rows[0]["method"], &*rows[0]["status"]),
        ("cube_shadow_map", "unavailable")
    );
    for (row, method) in rows[1..].iter().zip(methods) {
        assert_eq!(
            (&*row["method"], &*row["status"]),
            (method, "ok"),
            "{row:?}"
        );
        assert!(number(row, "within_step_share") >= 0.999, "{row:?}");
        assert!(number(row, "error_minutes_mean") < 0.1, "{row:?}");
    }
    let page = fs::read_to_string(one("profile.html")).unwrap();
    assert!(page.contains("data:image/png;base64,") && page.contains("silhouette_gs"));
    let info: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(one("profile.json")).unwrap()).unwrap();
    assert_eq!(
        (&info["date"], &info["step_minutes"]),
        (&"2026-09-18".into(), &60.0.into())
    );
}

/// The triangles of the wall in the north are in shade all day, and those in the south in the sun.
#[test]
fn walls_have_the_hours_of_their_side() {
    let room = room();
    let said = profile(
        room.path(),
        &[
            "tower.toml",
            "--step=1h",
            "--per-triangle",
            "--out=out",
            "--method=shadow_map",
        ],
    );
    assert!(
        said.status.success(),
        "{}",
        String::from_utf8_lossy(&said.stderr)
    );
    let rows = rows(&room.path().join("out/triangles.csv"));
    let hours: Vec<f64> = rows.iter().map(|row| number(row, "sun_hours")).collect();
    // Walls in the order of the file: north, east, south, west; then the roof, and the ground.
    assert_eq!(hours[0..2], [0.0, 0.0], "north");
    assert_eq!(hours[4..6], [8.0, 8.0], "south");
    assert_eq!(hours[8..10], [8.0, 8.0], "roof");
    assert!(
        hours[2] > 3.0 && hours[2] < 5.0 && hours[6] > 3.0 && hours[6] < 5.0,
        "{hours:?}"
    );
    assert!((number(&rows[0], "area") - 3.0).abs() < 1e-9);
    assert_eq!(rows.len(), 12);
}

#[test]
fn a_day_that_cannot_be_says_why() {
    let room = room();
    let place = ["--latitude=48.2", "--longitude=16.37"];
    let day = ["--date=2026-09-18", "--zone=Europe/Vienna"];
    let times = ["--from=10:00", "--to=12:00"];
    let lamp = |more: &[&'static str]| [&["lamp.toml", "--out=out"], more].concat();
    let tower = |more: &[&'static str]| [&["tower.toml", "--out=out"], more].concat();
    let cases: Vec<(Vec<&str>, &str)> = vec![
        (
            tower(&["--zone=Europe/Viena"]),
            "--zone: unknown time zone `Europe/Viena`; did you mean `Europe/Vienna`?",
        ),
        (
            tower(&["--date=2026-02-30"]),
            "--date: there is no 2026-02-30: February 2026 has 28 days",
        ),
        (
            tower(&["--date=18.9.2026"]),
            "--date: `18.9.2026` is not a date like 2026-09-18",
        ),
        (tower(&["--from=9h"]), "--from: `9h` is not a time of day"),
        (
            tower(&["--from=18:00"]),
            "--to: 17:00:00 is not after 18:00:00",
        ),
        (
            tower(&["--step=0m"]),
            "--step: a step must be longer than 0",
        ),
        (
            tower(&["--step=-30m"]),
            "--step: a step must be longer than 0",
        ),
        (
            tower(&["--step=30"]),
            "--step: `30` is not a length of time like 30m",
        ),
        (
            tower(&["--step=9h"]),
            "--step: a step of 9h is longer than the time",
        ),
        (
            tower(&["--latitude=91", "--longitude=0"]),
            "a latitude is from -90 to 90",
        ),
        (
            tower(&["--latitude=69.65", "--longitude=18.96", "--date=2026-12-21"]),
            "that day it does not rise",
        ),
        (
            tower(&["--from=20:00", "--to=23:00"]),
            "rises at 06:37 and sets at 18:59",
        ),
        (
            tower(&["--date=2026-03-29", "--from=02:30"]),
            "--from: on 2026-03-29 clocks in Europe/Vienna do not show 02:30:00",
        ),
        (tower(&["--north=0,1,0"]), "north and up lie on one line"),
        (
            tower(&["--time=9"]),
            "--time: the flight lasts from 0 to 4 s",
        ),
        (tower(&["--method=silhouette"]), "silhouette"),
        (
            tower(&["--method=shadow_map", "--method=shadow_map"]),
            "is given twice",
        ),
        (lamp(&[]), "--from: the scene has no sun of its own"),
        (
            lamp(&[&times[..], &day[..]].concat()),
            "--latitude: the scene has no sun of its own",
        ),
        (
            lamp(&[&times[..], &place[..]].concat()),
            "--date: the scene has no sun of its own",
        ),
    ];
    for (args, expected) in cases {
        let said = profile(room.path(), &args);
        let errors = String::from_utf8_lossy(&said.stderr);
        assert_eq!(said.status.code(), Some(2), "{args:?}: {errors}");
        assert!(errors.contains(expected), "{args:?}: {errors}");
        assert!(!room.path().join("out").exists(), "{args:?}");
    }
    let all = [&place[..], &day[..], &times[..], &["--method=shadow_map"]].concat();
    let said = profile(room.path(), &lamp(&all));
    assert!(
        said.status.success(),
        "{}",
        String::from_utf8_lossy(&said.stderr)
    );
}
