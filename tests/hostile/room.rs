//! A folder of its own for each test, and the program started in it.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// A run of one small scene with two methods.
pub(crate) const CONFIG: &str = r#"
title = "Hostile"
size = [64, 48]
frames = 3
warmup_frames = 0
verified_frames = 1
[[scenes]]
scene = "sphere_grid"
slices = 8
[[methods]]
id = "shadow_map"
resolution = 256
[[methods]]
id = "cube_shadow_map"
resolution = 64
"#;

/// A caster over a floor, in an OBJ file.
pub(crate) const MODEL: &str = "\
o sheet\nv -1 1 -1\nv -1 1 1\nv 1 1 -1\nv 1 1 1\nf 1 2 3\nf 3 2 4\n\
o floor\nv -4 0 -4\nv -4 0 4\nv 4 0 -4\nv 4 0 4\nf 5 6 7\nf 7 6 8\n";

/// The scene file of `model.obj`.
pub(crate) const SCENE: &str = r#"
title = "A sheet over a floor"
[mesh]
kind = "obj"
file = "model.obj"
up = "y"
receivers = ["floor"]
[light]
position = [0.5, 4.0, 0.25]
[camera]
fov_deg = 60.0
near = 0.1
keys = [{ time_s = 0.0, eye = [3.0, 3.0, 4.0], target = [0.0, 0.0, 0.0] }]
"#;

/// A folder that goes with the test.
pub(crate) struct Room(tempfile::TempDir);

impl Room {
    /// An empty one.
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// One with `config.toml`, `scene.toml` and `model.obj`.
    pub(crate) fn furnished() -> Self {
        let room = Self::new();
        room.write("config.toml", CONFIG);
        room.write("scene.toml", SCENE);
        room.write("model.obj", MODEL);
        room
    }

    /// A path in it.
    pub(crate) fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: impl AsRef<Path>, text: impl AsRef<[u8]>) {
        fs::write(self.path(name), text).unwrap();
    }

    pub(crate) fn read(&self, name: impl AsRef<Path>) -> String {
        String::from_utf8(fs::read(self.path(name)).unwrap()).unwrap()
    }

    /// What the JSON file says.
    pub(crate) fn json(&self, name: impl AsRef<Path>) -> serde_json::Value {
        serde_json::from_str(&self.read(name)).unwrap()
    }

    /// The program with the folder as its working directory, and no cache.
    pub(crate) fn svbench<S: AsRef<OsStr>>(&self, args: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_svbench"));
        command.args(args).current_dir(self.0.path());
        command.env("SVBENCH_CACHE", "").stdin(Stdio::null());
        command
    }

    /// A line for `sh`, in which `$svbench` is the program.
    pub(crate) fn shell(&self, line: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", line]).current_dir(self.0.path());
        command.env("svbench", env!("CARGO_BIN_EXE_svbench"));
        command.env("SVBENCH_CACHE", "").stdin(Stdio::null());
        command
    }
}

/// What a command says on standard output and standard error, once it has ended with this exit code.
pub(crate) fn ends(command: &mut Command, code: i32) -> (String, String) {
    let output = command.output().unwrap();
    check(&output, code, &format!("{command:?}"));
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr))
}

/// Fails if the program panicked, or if it ended with another exit code.
pub(crate) fn check(output: &Output, code: i32, what: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(!errors.contains("panicked"), "{what}: {errors}");
    assert_eq!(output.status.code(), Some(code), "{what}: {errors}");
}

/// Waits until the condition holds, or for the program to end.
pub(crate) fn wait_until(child: &mut Child, mut condition: impl FnMut() -> bool) {
    let started = Instant::now();
    while !condition() {
        assert!(started.elapsed() < Duration::from_secs(120), "too late");
        if child.try_wait().unwrap().is_some() {
            return;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}
