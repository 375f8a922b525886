//! Which runs may stand side by side, and which of them are one device's.

use std::path::Path;

use anyhow::{Result, bail};

use super::load::{Run, unique};
use crate::record::RunInfo;

/// Runs of one device with equal settings: one group of columns in a table.
#[derive(Debug)]
pub(crate) struct Group<'a> {
    /// The device, and what tells it from the other groups.
    pub label: String,
    /// Whether the device is a rasteriser in software, whose times say nothing about GPUs.
    pub software: bool,
    pub runs: Vec<&'a Run>,
}

/// The settings in which runs must agree for their times to be compared: each with its name in `run.json`, its
/// value, and the value as a group's label says it.
fn settings(info: &RunInfo) -> [(&'static str, String, String); 5] {
    let px = |side: u32| format!("{side} px");
    let (frames, version) = (info.frames, &info.program_version);
    let scale = match info.scale.as_str() {
        "" => "full",
        scale => scale,
    };
    [
        ("width", px(info.width), px(info.width) + " wide"),
        ("height", px(info.height), px(info.height) + " high"),
        ("frames", frames.to_string(), format!("{frames} frames")),
        (
            "program_version",
            version.clone(),
            format!("svbench {version}"),
        ),
        ("scale", scale.to_owned(), format!("scale {scale}")),
    ]
}

/// The runs by device, in the order in which the devices appear.
///
/// # Errors
/// Where settings differ in which runs must agree, unless `force` is set: then such runs are groups
/// of their own, labelled with what differs.
pub(crate) fn group(runs: &[Run], force: bool) -> Result<Vec<Group<'_>>> {
    let Some(first) = runs.first() else {
        return Ok(Vec::new());
    };
    if !force {
        runs.iter()
            .try_for_each(|run| check_comparable(first, run))?;
    }
    let wanted = settings(&first.info);
    let differs = |index: &usize| {
        runs.iter()
            .any(|run| settings(&run.info)[*index] != wanted[*index])
    };
    let differing: Vec<usize> = (0..wanted.len()).filter(differs).collect();
    // What the runs of a group have in common: the device, its driver, and the settings in which the runs differ.
    let key = |run: &'_ Run| {
        let labels = settings(&run.info).map(|(_, _, label)| label);
        let labels = differing.iter().map(|index| labels[*index].clone());
        let device = run.info.device.clone();
        (device.name, device.driver_info, labels.collect::<Vec<_>>())
    };
    let keys = unique(runs.iter().map(key));
    let group = |own: &(String, String, Vec<String>)| {
        let (device, driver, labels) = own;
        let is_twin = |(other, other_driver, _): &_| other == device && other_driver != driver;
        let driver = keys.iter().any(is_twin).then_some(driver);
        let details: Vec<&str> = driver
            .into_iter()
            .chain(labels)
            .map(String::as_str)
            .collect();
        let runs: Vec<&Run> = runs.iter().filter(|run| key(run) == *own).collect();
        Group {
            label: match details.as_slice() {
                [] => device.clone(),
                details => format!("{device} ({})", details.join(", ")),
            },
            software: runs.iter().any(|run| run.info.device.is_software()),
            runs,
        }
    };
    Ok(keys.iter().map(group).collect())
}

fn check_comparable(first: &Run, other: &Run) -> Result<()> {
    let both = settings(&first.info).into_iter().zip(settings(&other.info));
    let differing = both.filter(|(ours, theirs)| ours != theirs);
    let differing: Vec<String> = differing
        .map(|((name, ours, _), (_, theirs, _))| format!("{name}: {ours} and {theirs}"))
        .collect();
    if differing.is_empty() {
        return Ok(());
    }
    bail!(
        "{} and {} cannot be compared; they differ in {}. Give runs with equal settings, or --force \
         to show them in columns of their own",
        first.dir.display(),
        other.dir.display(),
        differing.join("; ")
    )
}

/// Fails if one directory was given twice, under whatever name.
pub(super) fn check_distinct<'a>(dirs: impl IntoIterator<Item = &'a Path>) -> Result<()> {
    let mut seen = Vec::new();
    for dir in dirs {
        // One that cannot be resolved is reported when it is read.
        let real = dir.canonicalize().unwrap_or_else(|_| dir.to_owned());
        if seen.contains(&real) {
            bail!("{} is given twice: name each run once", dir.display());
        }
        seen.push(real);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::paper_run;

    fn labels(runs: &[Run], force: bool) -> Vec<(String, usize)> {
        let groups = group(runs, force).unwrap();
        let label = |group: &Group<'_>| (group.label.clone(), group.runs.len());
        groups.iter().map(label).collect()
    }

    #[test]
    fn runs_of_one_device_and_driver_are_one_group() {
        let mut runs = [
            paper_run("a", "A GPU", &[]),
            paper_run("b", "B GPU", &[]),
            paper_run("c", "A GPU", &[]),
        ];
        assert_eq!(
            labels(&runs, false),
            [("A GPU".to_owned(), 2), ("B GPU".to_owned(), 1)]
        );
        runs[2].info.device.driver_info = "2.0".to_owned();
        let found = labels(&runs, false);
        assert_eq!(found[2], ("A GPU (2.0)".to_owned(), 1));
    }

    #[test]
    fn runs_that_differ_are_refused_with_all_that_differs() {
        let mut runs = [paper_run("a", "A GPU", &[]), paper_run("b", "A GPU", &[])];
        runs[1].info.width = 32;
        runs[1].info.frames = 9;
        runs[1].info.program_version = "0.2.0".to_owned();
        runs[1].info.scale = "small".to_owned();
        let error = group(&runs, false).unwrap_err().to_string();
        for part in [
            "a and b cannot be compared",
            "width: 64 px and 32 px",
            "frames: 3 and 9",
            "program_version: 0.1.0 and 0.2.0",
            "scale: full and small",
            "--force",
        ] {
            assert!(error.contains(part), "{part}: {error}");
        }
        assert!(!error.contains("height"), "{error}");
    }

    #[test]
    fn forced_runs_stand_apart_and_say_how_they_differ() {
        let mut runs = [
            paper_run("a", "A GPU", &[]),
            paper_run("b", "A GPU", &[]),
            paper_run("c", "A GPU", &[]),
        ];
        runs[1].info.frames = 9;
        assert_eq!(
            labels(&runs, true),
            [
                ("A GPU (3 frames)".to_owned(), 2),
                ("A GPU (9 frames)".to_owned(), 1)
            ]
        );
    }
}
