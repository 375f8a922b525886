//! A disk that is full, and files that were cut after the run.

use crate::room::{CONFIG, Room, ends};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A small disk in a room, if this machine lets a test have one.
struct Disk<'a>(&'a Path);

impl<'a> Disk<'a> {
    fn mount(at: &'a Path, kib: u32) -> Option<Self> {
        fs::create_dir(at).unwrap();
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", &format!("size={kib}k"), "tmpfs"]);
        let mounted = mount
            .arg(at)
            .output()
            .is_ok_and(|output| output.status.success());
        mounted.then_some(Self(at))
    }
}

impl Drop for Disk<'_> {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0).status();
    }
}

#[test]
fn a_run_on_a_full_disk_has_failed_and_says_what_failed_first() {
    let room = Room::new();
    room.write(
        "config.toml",
        CONFIG.replace("frames = 3", "frames = 100000"),
    );
    let at = room.path("disk");
    let Some(_disk) = Disk::mount(&at, 128) else {
        return;
    };
    let (_, errors) = ends(
        &mut room.svbench(["run", "config.toml", "--out", "disk/run"]),
        1,
    );
    assert!(
        errors.contains("samples.csv") && errors.contains("No space left"),
        "{errors}"
    );
    assert_eq!(room.json("disk/run/run.json")["status"], "failed");
}

#[test]
fn what_was_cut_since_the_run_is_no_result() {
    let room = Room::furnished();
    ends(&mut room.svbench(["run", "config.toml", "--out", "run"]), 0);
    ends(&mut room.svbench(["report", "run"]), 0);
    let picture = "images/sphere_grid_n8__shadow_map__resolution-256_mask.png";
    for file in ["samples.csv", "summary.csv", "metrics.csv", picture] {
        let path = room.path("run").join(file);
        let whole = fs::read(&path).unwrap();
        let line_end = whole
            .iter()
            .rposition(|byte| *byte == b'\n')
            .unwrap_or(whole.len() / 2);
        let row_less = whole[..line_end]
            .iter()
            .rposition(|byte| *byte == b'\n')
            .unwrap_or(line_end / 2)
            + 1;
        for cut in [&whole[..row_less], &whole[..line_end], b""] {
            fs::write(&path, cut).unwrap();
            let (_, errors) = ends(&mut room.svbench(["report", "run"]), 1);
            assert!(
                errors.contains(file) && errors.contains("run.json"),
                "{errors}"
            );
        }
        fs::write(&path, &whole).unwrap();
    }
    room.write("run/notes.txt", "mine");
    room.write("run/images/mine.png", "mine");
    ends(&mut room.svbench(["report", "run"]), 0);
    // A run may be kept without its pictures.
    fs::remove_file(room.path("run").join(picture)).unwrap();
    ends(&mut room.svbench(["report", "run"]), 0);
    assert!(room.read("run/report.html").contains("is missing although"));
}

#[test]
fn what_was_cut_since_a_stress_run_is_no_result() {
    let room = Room::new();
    let args = [
        "stress",
        "--cause",
        "contact",
        "--method",
        "shadow_map",
        "--size",
        "32x24",
        "--out",
        "stress",
    ];
    room.svbench(args).output().unwrap();
    ends(&mut room.svbench(["report", "stress"]), 0);
    let rows = room.read("stress/stability.csv");
    let cut = rows[..rows.len() - 1].rfind('\n').unwrap() + 1;
    room.write("stress/stability.csv", &rows[..cut]);
    let (_, errors) = ends(&mut room.svbench(["report", "stress"]), 1);
    assert!(errors.contains("stability.csv"), "{errors}");
}
