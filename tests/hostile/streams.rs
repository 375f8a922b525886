//! Standard output and standard error that are closed, full, or read by nobody: prints never decide about results.

use crate::room::{Room, ends};

/// How a shell takes each stream from the program.
const LOST: [&str; 6] = [
    "> /dev/full",
    "2> /dev/full",
    "> /dev/full 2> /dev/full",
    ">&-",
    "2>&-",
    "<&- >&- 2>&-",
];

#[test]
fn a_measurement_does_not_hang_on_what_it_prints() {
    for (i, lost) in LOST.iter().enumerate() {
        let room = Room::furnished();
        let line = format!("$svbench run config.toml --out run {lost}");
        ends(&mut room.shell(&line), 0);
        assert_eq!(
            room.json("run/run.json")["status"],
            "complete",
            "{i}: {lost}"
        );
        assert!(room.path("run/report.html").is_file(), "{lost}");
    }
}

#[test]
fn a_reader_that_goes_away_does_not_end_a_measurement() {
    let room = Room::furnished();
    let line = "($svbench run config.toml --out run; echo $? > code) 2>&1 | true";
    ends(&mut room.shell(line), 0);
    let started = std::time::Instant::now();
    while !room.path("code").is_file() && started.elapsed().as_secs() < 120 {
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    assert_eq!(room.read("code").trim(), "0");
    assert_eq!(room.json("run/run.json")["status"], "complete");
}

#[test]
fn what_is_read_in_part_is_no_error() {
    let room = Room::furnished();
    let commands = [
        "list",
        "list --json",
        "--help",
        "run --help",
        "--version",
        "render scene.toml --method shadow_map --size 64x48",
        "render scene.toml --method shadow_map --size 64x48 --json",
        "metamorphic scene.toml --size 32x24 --soups 0 --method shadow_map",
        "fuzz --cases 2 --size 32x24",
    ];
    for command in commands {
        let line = format!("$svbench {command} 2> errors | true");
        ends(&mut room.shell(&line), 0);
        let errors = room.read("errors");
        assert!(!errors.contains("panicked"), "{command}: {errors}");
        let line = format!("$svbench {command} >&- 2> errors");
        ends(&mut room.shell(&line), 0);
    }
}

#[test]
fn a_result_that_is_printed_and_gets_lost_is_an_error() {
    let room = Room::furnished();
    let commands = [
        "list methods",
        "list scenes --json",
        "--help",
        "--version",
        "render scene.toml --method shadow_map --size 64x48",
        "render scene.toml --method shadow_map --size 64x48 --json",
        "metamorphic scene.toml --size 32x24 --soups 0 --method shadow_map",
        "fuzz --cases 2 --size 32x24",
    ];
    for command in commands {
        let line = format!("$svbench {command} > /dev/full");
        let (_, errors) = ends(&mut room.shell(&line), 1);
        assert!(errors.contains("standard output"), "{command}: {errors}");
    }
}
