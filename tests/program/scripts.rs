//! The scripts that set a machine up, on one that lacks things and does not let its user install them.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output};

/// A program of this name that does what the shell script says.
fn stand_in(folder: &Path, name: &str, script: &str) {
    let path = folder.join(name);
    fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
}

/// Runs `scripts/run.sh` as a user who may install nothing and has the Vulkan drivers of `driver_files` alone.
/// Nothing is built: `cargo` says so and fails.
fn run(driver_files: &Path) -> Output {
    let folder = tempfile::tempdir().unwrap();
    stand_in(folder.path(), "cargo", "echo building; exit 7");
    stand_in(folder.path(), "id", "echo 1000");
    stand_in(folder.path(), "sudo", "exit 1");
    stand_in(folder.path(), "c++", "exit 0");
    stand_in(folder.path(), "apt-get", "exit 100");
    stand_in(folder.path(), "apt-cache", "exit 0");
    let path = format!("{}:/usr/bin:/bin", folder.path().display());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/run.sh");
    let mut command = Command::new("bash");
    command.arg(script).env_clear().env("PATH", path);
    command.env("VK_DRIVER_FILES", driver_files);
    command.output().unwrap()
}

#[test]
fn without_a_driver_the_user_hears_what_to_install_before_the_build() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(&folder.path().join("none.json"));
    let words = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{words}");
    assert!(output.stdout.is_empty(), "nothing is built");
    let os = fs::read_to_string("/etc/os-release").unwrap_or_default();
    if os.contains("VERSION_CODENAME=bookworm") {
        let commands = [
            "cat > /etc/apt/sources.list.d/bookworm-backports.sources <<'END'\nTypes: deb\nURIs: http",
            "\nSuites: bookworm-backports\n",
            "\nEND\napt-get update\n",
            "\napt-get install -y -t bookworm-backports mesa-vulkan-drivers libvulkan1\n",
        ];
        let places = commands.map(|command| words.find(command));
        assert!(places.iter().all(Option::is_some), "{words}");
        assert!(places.is_sorted(), "{words}");
    } else {
        assert!(words.contains("mesa-vulkan-drivers"), "{words}");
    }
}

#[test]
fn with_a_driver_the_build_begins() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a driver.json"), "{}").unwrap();
    // A file, or a folder of files.
    for driver_files in [
        folder.path().join("a driver.json"),
        folder.path().to_owned(),
    ] {
        let output = run(&driver_files);
        assert_eq!(output.stdout, b"building\n");
        assert_eq!(output.status.code(), Some(7));
    }
}
