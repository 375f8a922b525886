//! Which runs may stand side by side, and which of them are one device's.

use std::path::Path;

use anyhow::{Result, bail};

use super::load::Run;
use crate::record::RunInfo;

/// Runs of one device with equal settings: one group of columns in a table.
#[derive(Debug)]
pub struct Group<'a> {
    /// The device, and what tells it from the other groups.
    pub label: String,
    /// Whether the device is a rasteriser in software, whose times say nothing about GPUs.
    pub software: bool,
    /// Its runs.
    pub runs: Vec<&'a Run>,
}

/// A setting in which runs must agree for their times to be compared.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Setting {
    /// Its name in `run.json`.
    name: &'static str,
    value: String,
    /// The value as a group's label says it.
    label: String,
}

fn settings(info: &RunInfo) -> [Setting; 5] {
    let RunInfo {
        width,
        height,
        frames,
        program_version,
        ..
    } = info;
    let scale = if info.scale.is_empty() {
        "full"
    } else {
        &info.scale
    };
    [
        ("width", format!("{width} px"), format!("{width} px wide")),
        (
            "height",
            format!("{height} px"),
            format!("{height} px high"),
        ),
        ("frames", frames.to_string(), format!("{frames} frames")),
        (
            "program_version",
            program_version.clone(),
            format!("svbench {program_version}"),
        ),
        ("scale", scale.to_owned(), format!("scale {scale}")),
    ]
    .map(|(name, value, label)| Setting { name, value, label })
}

/// The runs by device, in the order in which the devices appear.
///
/// # Errors
/// Where settings differ in which runs must agree, unless `force` is set: then such runs are groups
/// of their own, labelled with what differs.
pub fn group(runs: &[Run], force: bool) -> Result<Vec<Group<'_>>> {
    let Some(first) = runs.first() else {
        return Ok(Vec::new());
    };
    let wanted = settings(&first.info);
    let differs = |index: usize| {
        let values = runs.iter().map(|run| settings(&run.info)[index].clone());
        values.into_iter().any(|value| value != wanted[index])
    };
    let differing: Vec<usize> = (0..wanted.len()).filter(|index| differs(*index)).collect();
    if !force {
        runs.iter()
            .try_for_each(|run| check_comparable(first, run))?;
    }

    let mut groups: Vec<(Key<'_>, Group<'_>)> = Vec::new();
    for run in runs {
        let key = Key::of(run, &differing);
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, group)) => group.runs.push(run),
            None => groups.push((
                key,
                Group {
                    label: String::new(),
                    software: run.info.device.is_software(),
                    runs: vec![run],
                },
            )),
        }
    }
    let labels: Vec<String> = groups
        .iter()
        .map(|(key, _)| {
            let twin = |(other, _): &&(Key<'_>, Group<'_>)| {
                other.device == key.device && other.driver_info != key.driver_info
            };
            key.label(groups.iter().any(|entry| twin(&entry)))
        })
        .collect();
    let labelled = groups.into_iter().zip(labels);
    Ok(labelled
        .map(|((_, group), label)| Group { label, ..group })
        .collect())
}

/// What the runs of a group have in common.
#[derive(Debug, PartialEq, Eq)]
struct Key<'a> {
    device: &'a str,
    driver_info: &'a str,
    /// The settings in which the runs given differ.
    differing: Vec<Setting>,
}

impl<'a> Key<'a> {
    fn of(run: &'a Run, differing: &[usize]) -> Self {
        let all = settings(&run.info);
        Self {
            device: &run.info.device.name,
            driver_info: &run.info.device.driver_info,
            differing: differing.iter().map(|index| all[*index].clone()).collect(),
        }
    }

    fn label(&self, with_driver: bool) -> String {
        let driver = with_driver.then(|| self.driver_info.to_owned());
        let differing = self.differing.iter().map(|setting| setting.label.clone());
        let details: Vec<String> = driver.into_iter().chain(differing).collect();
        if details.is_empty() {
            self.device.to_owned()
        } else {
            format!("{} ({})", self.device, details.join(", "))
        }
    }
}

fn check_comparable(first: &Run, other: &Run) -> Result<()> {
    let (ours, theirs) = (settings(&first.info), settings(&other.info));
    let differing: Vec<String> = ours
        .iter()
        .zip(&theirs)
        .filter(|(ours, theirs)| ours != theirs)
        .map(|(ours, theirs)| format!("{}: {} and {}", ours.name, ours.value, theirs.value))
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
