//! Outputs that are devices, pipes, links, inputs or each other; their modes; and results that are better than new
//! ones.

use crate::room::{MODEL, Room, ends};
use std::fs;
use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

const RENDER: [&str; 6] = [
    "render",
    "scene.toml",
    "--method",
    "shadow_map",
    "--size",
    "32x24",
];
const PNG: &[u8] = b"\x89PNG";

fn render(room: &Room, more: &[&str], code: i32) -> String {
    ends(&mut room.svbench([&RENDER[..], more].concat()), code).1
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().mode() & 0o777
}

/// A device like one of the system's; the test's own, where it may have one, so that a mistake costs the machine
/// nothing.
fn device(room: &Room, name: &str, minor: &str) -> PathBuf {
    let own = room.path(name);
    let mut mknod = Command::new("mknod");
    let made = mknod.arg(&own).args(["c", "1", minor]).output();
    let is_made = made.is_ok_and(|made| made.status.success());
    if is_made && fs::OpenOptions::new().write(true).open(&own).is_ok() {
        own
    } else {
        Path::new("/dev").join(name)
    }
}

#[test]
fn a_device_is_written_to_and_stays() {
    let room = Room::furnished();
    let (null, full) = (device(&room, "null", "3"), device(&room, "full", "7"));
    let before = fs::metadata(&null).unwrap();
    let [null_name, full_name] = [&null, &full].map(|path| path.to_str().unwrap());
    render(&room, &["--out", null_name, "--mask", null_name], 0);
    let after = fs::metadata(&null).unwrap();
    assert!(after.file_type().is_char_device());
    assert_eq!((after.ino(), after.mode()), (before.ino(), before.mode()));
    let errors = render(&room, &["--mask", full_name], 1);
    let words = format!("cannot write {full_name}");
    assert!(errors.contains(&words), "{errors}");
    assert!(fs::metadata(&full).unwrap().file_type().is_char_device());
}

#[test]
fn a_pipe_is_written_to_and_stays() {
    let room = Room::furnished();
    let line = "mkfifo pipe && (cat pipe > got & $svbench render scene.toml --method shadow_map --size 32x24 \
                --mask pipe && wait)";
    ends(&mut room.shell(line), 0);
    assert!(
        fs::metadata(room.path("pipe"))
            .unwrap()
            .file_type()
            .is_fifo()
    );
    assert!(fs::read(room.path("got")).unwrap().starts_with(PNG));
    let line = "$svbench render scene.toml --method shadow_map --size 32x24 --mask /dev/stdout | cat > got";
    ends(&mut room.shell(line), 0);
    assert!(fs::read(room.path("got")).unwrap().starts_with(PNG));
}

#[test]
fn links_stay_and_their_targets_are_written() {
    let room = Room::furnished();
    room.write("target.png", "old");
    symlink("target.png", room.path("link.png")).unwrap();
    symlink("later.png", room.path("dangling.png")).unwrap();
    room.write("one.png", "old");
    fs::hard_link(room.path("one.png"), room.path("two.png")).unwrap();
    render(
        &room,
        &[
            "--out",
            "link.png",
            "--mask",
            "dangling.png",
            "--error",
            "one.png",
        ],
        0,
    );
    assert!(room.path("link.png").is_symlink() && room.path("dangling.png").is_symlink());
    for written in ["target.png", "later.png", "two.png"] {
        assert!(
            fs::read(room.path(written)).unwrap().starts_with(PNG),
            "{written}"
        );
    }
}

#[test]
fn an_output_that_is_an_input_or_another_output_is_refused() {
    let room = Room::furnished();
    fs::hard_link(room.path("model.obj"), room.path("hard.obj")).unwrap();
    symlink("scene.toml", room.path("soft.png")).unwrap();
    fs::create_dir(room.path("sub")).unwrap();
    for more in [
        &["--out", "model.obj"][..],
        &["--mask", "./sub/../model.obj"],
        &["--mask", "hard.obj"],
        &["--reference", "soft.png"],
        &["--error", "scene.toml"],
        &["--out", "a.png", "--mask", "a.png"],
        &["--out", "a.png", "--mask", "sub/../a.png"],
    ] {
        let errors = render(&room, more, 2);
        assert!(errors.contains("name another file"), "{more:?}: {errors}");
    }
    assert!(!room.path("a.png").exists());
    let args = [
        "render",
        "model.obj",
        "--method",
        "shadow_map",
        "--out",
        "model.obj",
    ];
    ends(&mut room.svbench(args), 2);
    assert_eq!(room.read("model.obj"), MODEL);
}

#[test]
fn every_file_has_the_mode_that_the_umask_says() {
    let room = Room::furnished();
    let line = "umask 027; $svbench run config.toml --out run && $svbench minimise scene.toml --method \
                shadow_map,resolution=8,constant_bias=0,slope_bias=0 --seconds 5 --out left && \
                SVBENCH_CACHE=cache $svbench render scene.toml --method shadow_map --size 32x24 --mask mask.png && \
                $svbench stress --cause contact --method shadow_map --size 32x24 --out stress";
    // The stress run may find what no limit declares.
    room.shell(line).output().unwrap();
    let mut seen = 0;
    let mut folders = vec![
        room.path("run"),
        room.path("left"),
        room.path("cache"),
        room.path("stress"),
    ];
    let check = |path: &Path| {
        assert_eq!(mode(path), 0o640, "{}", path.display());
    };
    check(&room.path("mask.png"));
    while let Some(folder) = folders.pop() {
        for entry in folder
            .read_dir()
            .unwrap_or_else(|_| panic!("{}", folder.display()))
        {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                check(&path);
                seen += 1;
            }
        }
    }
    assert!(seen > 15, "{seen}");
}

#[test]
fn an_old_file_keeps_its_mode() {
    let room = Room::furnished();
    room.write("mask.png", "old");
    fs::set_permissions(room.path("mask.png"), fs::Permissions::from_mode(0o604)).unwrap();
    render(&room, &["--mask", "mask.png"], 0);
    assert_eq!(mode(&room.path("mask.png")), 0o604);
    assert!(fs::read(room.path("mask.png")).unwrap().starts_with(PNG));
}

#[test]
fn an_earlier_and_better_result_stays() {
    let room = Room::furnished();
    let minimise = |seconds: &str, method: &str, code: i32| {
        let args = [
            "minimise",
            "sphere_grid",
            "--method",
            method,
            "--out",
            "left",
            "--seconds",
            seconds,
        ];
        ends(&mut room.svbench(args), code)
    };
    let method = "shadow_map,resolution=16";
    minimise("60", method, 0);
    let (scene, model) = (
        room.read("left/sphere_grid_minimal.toml"),
        room.read("left/sphere_grid_minimal.obj"),
    );
    let (text, _) = minimise("0", method, 0);
    assert!(text.contains("stays"), "{text}");
    assert_eq!(room.read("left/sphere_grid_minimal.toml"), scene);
    assert_eq!(room.read("left/sphere_grid_minimal.obj"), model);
    // The answer to another question is not overwritten either.
    let (_, errors) = minimise("0", "shadow_map,resolution=32", 2);
    assert!(errors.contains("another question"), "{errors}");
    room.write("left/sphere_grid_minimal.toml", "mine");
    minimise("0", method, 2);
    assert_eq!(room.read("left/sphere_grid_minimal.toml"), "mine");
}

#[test]
fn no_cell_of_a_table_is_a_formula() {
    let room = Room::furnished();
    for name in ["=1+1", "@a", "-b", "+c"] {
        room.write(format!("{name}.toml"), crate::room::SCENE);
    }
    let mut config = crate::room::CONFIG.to_owned();
    for name in ["=1+1", "@a", "-b", "+c"] {
        config.push_str(&format!("[[scenes]]\nscene = \"{name}.toml\"\n"));
    }
    room.write("config.toml", config);
    ends(&mut room.svbench(["run", "config.toml", "--out", "run"]), 0);
    for table in [
        "samples.csv",
        "summary.csv",
        "stages.csv",
        "metrics.csv",
        "pareto.csv",
    ] {
        let mut reader = csv::Reader::from_path(room.path("run").join(table)).unwrap();
        let mut guarded = 0;
        for cell in reader
            .records()
            .flat_map(|row| row.unwrap().iter().map(str::to_owned).collect::<Vec<_>>())
        {
            let is_number = cell.parse::<f64>().is_ok();
            assert!(
                is_number || !cell.trim_start().starts_with(['=', '+', '-', '@']),
                "{table}: {cell}"
            );
            guarded += u32::from(cell.starts_with('\''));
        }
        assert!(guarded >= 4, "{table}: {guarded}");
    }
    // Read back, the names are what they were.
    ends(&mut room.svbench(["report", "run"]), 0);
    assert!(room.read("run/report.html").contains(">=1+1<"));
}
