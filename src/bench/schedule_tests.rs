//! The schedule without a device.

use super::Watched;
use super::runner::run_scenes;
use super::stand_in::{StandIn, Trouble};
use crate::config::RunPlan;
use crate::judge::Observer;
use crate::methods::Registry;
use crate::record::run_dir::RunDir;
use crate::record::{RunInfo, RunStatus, Sample, Status, Summary};
use std::collections::BTreeSet;
use std::path::Path;

const SETTINGS: &str =
    "title = \"t\"\nsize = [2, 2]\nframes = 3\nwarmup_frames = 1\nverified_frames = 2\nseed = 7\n";
const SCENES: &str = "[[scenes]]\nscene = \"sphere_grid\"\nrows = 1\ncolumns = 1\nslices = 4\n";
const METHODS: &str = "[[methods]]\nid = \"silhouette_gs\"\n[[methods]]\nid = \"shadow_map\"\n[[methods]]\nid = \"triangle_ts\"\n";
const ALL: [&str; 3] = ["silhouette_gs", "shadow_map", "triangle_ts"];

/// What a run left.
struct Ran {
    info: RunInfo,
    summaries: Vec<Summary>,
    samples: Vec<Sample>,
    _dir: tempfile::TempDir,
}

impl Ran {
    fn of(&self, method: &str) -> (Status, &str, u32) {
        let mut rows = self.summaries.iter();
        let row = rows.find(|row| row.method == method).unwrap();
        (row.status, &row.reason, row.frames)
    }

    fn assert_ok(&self, methods: &[&str]) {
        for method in methods {
            assert_eq!(self.of(method), (Status::Ok, "", 3), "{method}");
        }
    }
}

fn run(stand_in: &StandIn, config: &str) -> Ran {
    run_in(stand_in, config, Path::new(""))
}

fn run_in(stand_in: &StandIn, config: &str, base: &Path) -> Ran {
    let plan = RunPlan::parse(config, "test.toml", base, "full", &Registry::builtin()).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let mut run_dir = RunDir::create(&dir.path().join("run")).unwrap();
    let (mut info, mut summaries) = (RunInfo::default(), Vec::new());
    let watched = Watched {
        plan: &plan,
        observer: stand_in,
    };
    stand_in.begin(plan.steps_per_scene() * plan.scenes.len() as u64);
    let mut executor = stand_in;
    run_scenes(
        watched,
        &mut executor,
        &mut run_dir,
        &mut info,
        &mut summaries,
    )
    .unwrap();
    let samples = csv::Reader::from_path(dir.path().join("run/samples.csv"))
        .unwrap()
        .deserialize()
        .map(Result::unwrap)
        .collect();
    Ran {
        info,
        summaries,
        samples,
        _dir: dir,
    }
}

fn config(parts: &[&str]) -> String {
    parts.concat()
}

#[test]
fn methods_take_turns_in_a_shuffled_order_after_warming_up() {
    let stand_in = StandIn::default();
    let ran = run(&stand_in, &config(&[SETTINGS, SCENES, METHODS]));
    ran.assert_ok(&ALL);
    assert_eq!(ran.info.status, RunStatus::Complete);
    let drawn = stand_in.logged("draw");
    let rounds: Vec<Vec<(&str, &str)>> = drawn
        .chunks(3)
        .map(|round| {
            round
                .iter()
                .map(|line| line.split_once(' ').unwrap())
                .collect()
        })
        .collect();
    assert_eq!(rounds.len(), 4, "one to warm up, three measured");
    for round in &rounds {
        let methods: BTreeSet<_> = round.iter().map(|(method, _)| *method).collect();
        assert_eq!(methods, BTreeSet::from(ALL), "{round:?}");
        assert!(
            round.iter().all(|(_, time)| *time == round[0].1),
            "{round:?}"
        );
    }
    assert_eq!(rounds[0][0].1, rounds[1][0].1, "warming up at the start");
    let orders: BTreeSet<Vec<&str>> = rounds
        .iter()
        .map(|round| round.iter().map(|(method, _)| *method).collect())
        .collect();
    assert!(orders.len() > 1, "the order is shuffled: {rounds:?}");
    // Nothing of warming up is kept, and no verification comes after the first measured frame.
    assert_eq!(ran.samples.len(), 9);
    assert!(ran.samples.iter().all(|sample| sample.order >= 3));
    assert!(ran.samples.iter().all(|sample| sample.shadow_ms == 2.0));
    let log = stand_in.log.borrow();
    let last = log.iter().rposition(|line| line.starts_with("verify"));
    let first = log.iter().position(|line| line.starts_with("draw"));
    assert!(last < first);
    let (steps, done) = stand_in.progress();
    assert_eq!((steps, done), (18, 18));
}

#[test]
fn the_seed_decides_the_order() {
    let drawn = |seed: &str| {
        let stand_in = StandIn::default();
        let settings = SETTINGS.replace("seed = 7", seed);
        let settings = settings.replace("frames = 3\nw", "frames = 9\nw");
        run(&stand_in, &config(&[&settings, SCENES, METHODS]));
        stand_in.logged("draw")
    };
    assert_eq!(drawn("seed = 7"), drawn("seed = 7"));
    assert_ne!(drawn("seed = 7"), drawn("seed = 8"));
}

#[test]
fn every_frame_that_counts_is_led_in_to() {
    let stand_in = StandIn::default();
    let settings = format!("{SETTINGS}lead_in = 2\n");
    let ran = run(&stand_in, &config(&[&settings, SCENES, METHODS]));
    ran.assert_ok(&ALL);
    let drawn = stand_in.logged("draw");
    assert_eq!(drawn.len(), 12);
    for line in &drawn {
        let times: Vec<f64> = line
            .split(' ')
            .skip(1)
            .map(|s| s.parse().unwrap())
            .collect();
        assert_eq!(times.len(), 3, "{line}");
        let step_s = if times[2] == 0.0 { 0.0 } else { 1.0 / 60.0 };
        assert!((times[2] - times[1] - step_s).abs() < 0.011, "{line}");
        assert!((times[1] - times[0] - step_s).abs() < 0.011, "{line}");
    }
    assert_eq!(ran.samples.len(), 9, "only what counts is kept");
}

#[test]
fn a_cell_that_breaks_ends_and_the_others_go_on() {
    let trouble = [
        ("prepare shadow_map", 0, "it broke"),
        ("verify shadow_map 1", 0, "verifying at"),
        (
            "draw shadow_map 0.00",
            0,
            "frame 0 at 0.0 s of the flight: it broke",
        ),
        (
            "wait shadow_map 8.00",
            1,
            "frame 1 at 8.0 s of the flight: it broke",
        ),
    ];
    for (request, frames, reason) in trouble {
        let stand_in = StandIn::default().on(request, Trouble::Breaks);
        let ran = run(&stand_in, &config(&[SETTINGS, SCENES, METHODS]));
        ran.assert_ok(&["silhouette_gs", "triangle_ts"]);
        let (status, found, measured) = ran.of("shadow_map");
        assert_eq!((status, measured), (Status::Failed, frames), "{request}");
        assert!(found.contains(reason), "{request}: {found}");
        assert_eq!(stand_in.logged("open").len(), 1, "{request}");
    }
    let stand_in = StandIn::default().on("prepare shadow_map", Trouble::Unavailable);
    let ran = run(&stand_in, &config(&[SETTINGS, SCENES, METHODS]));
    assert_eq!(ran.of("shadow_map"), (Status::Unavailable, "not here", 0));
    ran.assert_ok(&["silhouette_gs", "triangle_ts"]);
    assert_eq!(stand_in.progress(), (18, 18));
}

#[test]
fn after_a_loss_the_run_goes_on_where_it_was() {
    for request in [
        "prepare shadow_map",
        "verify shadow_map 1",
        "draw shadow_map 16.00",
        "wait shadow_map 8.00",
    ] {
        let stand_in = StandIn::default().on(request, Trouble::Loses);
        let ran = run(&stand_in, &config(&[SETTINGS, SCENES, METHODS]));
        // With frames of others under way, the device was lost by the oldest of them.
        let failed = ran
            .summaries
            .iter()
            .filter(|row| row.status == Status::Failed);
        let failed: Vec<_> = failed.collect();
        assert_eq!(failed.len(), 1, "{request}");
        assert!(failed[0].reason.contains("the device was lost"));
        if !request.starts_with("draw") {
            assert_eq!(failed[0].method, "shadow_map", "{request}");
        }
        for row in ran
            .summaries
            .iter()
            .filter(|row| row.status != Status::Failed)
        {
            assert_eq!((row.status, row.frames), (Status::Ok, 3), "{request}");
            assert_eq!(row.verified_frames, 2, "{request}");
        }
        let frames: BTreeSet<_> = ran.samples.iter().map(|s| (&s.method, s.frame)).collect();
        assert_eq!(frames.len(), ran.samples.len(), "{request}: no frame twice");
        assert_eq!(stand_in.logged("open").len(), 2, "{request}");
        // Of those that were compared before the loss none is again.
        let verified = stand_in.logged("verify");
        let once: BTreeSet<_> = verified.iter().collect();
        assert_eq!(once.len(), verified.len(), "{request}: {verified:?}");
        assert_eq!(ran.info.warnings.len(), 1, "{:?}", ran.info.warnings);
    }
}

#[test]
fn a_device_that_does_not_open_again_ends_the_scene_alone() {
    let stand_in = StandIn::default().on("open", Trouble::Breaks);
    let other = SCENES.replace("slices = 4", "slices = 6");
    let ran = run(&stand_in, &config(&[SETTINGS, SCENES, &other, METHODS]));
    let of = |status| {
        let rows = ran.summaries.iter().filter(|row| row.status == status);
        rows.count()
    };
    assert_eq!((of(Status::Failed), of(Status::Ok)), (3, 3));
    assert_eq!(ran.info.scenes[0].reason, "it does not open");
}

#[test]
fn biases_are_found_before_anything_is_prepared_and_only_once() {
    let methods = METHODS.replace("\"shadow_map\"", "\"shadow_map\"\nslope_bias = \"search\"");
    let stand_in = StandIn::default().on("verify silhouette_gs 0", Trouble::Loses);
    let ran = run(&stand_in, &config(&[SETTINGS, SCENES, &methods]));
    ran.assert_ok(&["shadow_map", "triangle_ts"]);
    assert_eq!(stand_in.logged("search"), ["shadow_map"]);
    let log = stand_in.log.borrow();
    assert!(log[1].starts_with("search"), "{log:?}");
    let prepared = stand_in.logged("prepare");
    let with_bias = prepared
        .iter()
        .filter(|name| name.contains("slope_bias=2.5"));
    assert_eq!(with_bias.count(), 2, "{prepared:?}");
}

#[test]
fn an_interrupted_run_keeps_what_it_has() {
    let stand_in = StandIn::default().on("draw triangle_ts 8.00", Trouble::Interrupts);
    let ran = run(&stand_in, &config(&[SETTINGS, SCENES, SCENES_TWO, METHODS]));
    assert_eq!(ran.info.status, RunStatus::Interrupted);
    assert_eq!(ran.info.scenes.len(), 1, "the next scene is not begun");
    // Frame 0 of all, and of frame 1 whatever came up to the interruption, which is waited for.
    let measured: u32 = ran.summaries.iter().map(|row| row.frames).sum();
    assert!((4..=6).contains(&measured), "{measured}");
    assert_eq!(ran.samples.len(), measured as usize);
    let stand_in = StandIn::default().on("prepare triangle_ts", Trouble::Interrupts);
    let ran = run(&stand_in, &config(&[SETTINGS, SCENES, METHODS]));
    assert_eq!(ran.of("triangle_ts"), (Status::Skipped, "interrupted", 0));
}

const SCENES_TWO: &str = "[[scenes]]\nscene = \"sphere_grid\"\nrows = 1\ncolumns = 2\nslices = 4\n";

#[test]
fn a_scene_without_its_model_is_skipped_and_recorded() {
    let dir = tempfile::tempdir().unwrap();
    let scene = "title = \"t\"\n[mesh]\nkind = \"obj\"\nfile = \"nowhere.obj\"\nup = \"y\"\n[light]\n\
        position = [0.0, 8.0, 0.0]\n[camera]\nfov_deg = 45.0\nnear = 0.1\n\
        keys = [{ time_s = 0.0, eye = [3.0, 4.0, 6.0], target = [0.0, 0.0, 0.0] }]\n";
    std::fs::write(dir.path().join("gone.toml"), scene).unwrap();
    let scenes = format!("[[scenes]]\nscene = \"gone.toml\"\n{SCENES}");
    let stand_in = StandIn::default();
    let ran = run_in(
        &stand_in,
        &config(&[SETTINGS, &scenes, METHODS]),
        dir.path(),
    );
    assert_eq!(ran.summaries.len(), 6);
    for (row, method) in ran.summaries.iter().zip(ALL) {
        assert_eq!((&*row.scene, &*row.method), ("gone", method));
        assert_eq!(row.status, Status::Skipped);
        assert!(row.reason.contains("nowhere.obj"), "{}", row.reason);
    }
    assert!(
        ran.summaries[3..]
            .iter()
            .all(|row| row.status == Status::Ok)
    );
    assert_eq!(ran.info.scenes[0].status, Status::Skipped);
    let (steps, done) = stand_in.progress();
    assert_eq!(steps, done);
}

#[test]
fn a_cell_that_takes_too_long_ends_and_the_others_go_on() {
    let settings = format!("{SETTINGS}cell_timeout_s = 0.25\n");
    for (request, frames) in [
        ("draw shadow_map 8.00", 1),
        ("draw shadow_map 16.00", 2),
        ("wait shadow_map 16.00", 2),
    ] {
        let stand_in = StandIn::default().on(request, Trouble::Sleeps(300));
        let ran = run(&stand_in, &config(&[&settings, SCENES, METHODS]));
        ran.assert_ok(&["silhouette_gs", "triangle_ts"]);
        let (status, reason, measured) = ran.of("shadow_map");
        assert_eq!((status, measured), (Status::Failed, frames), "{request}");
        assert!(reason.contains("`cell_timeout_s`"), "{reason}");
        assert!(
            reason.starts_with(&format!("frame {frames} at")),
            "{reason}"
        );
    }
}
