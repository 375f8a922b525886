//! Points, fronts and the file, over made-up runs.

use std::collections::HashMap;
use std::path::Path;

use super::*;
use crate::record::SUMMARY_FILE;
use crate::report::fixture::swept_run;

fn named(method: &str, shadow_ms: f64, wrong_px: f64) -> Point {
    let contender = Contender {
        method: method.to_owned(),
        variant: String::new(),
    };
    Point {
        curve: Curve::of(&contender, None),
        contender,
        sweep: None,
        shadow_ms,
        shadow_ms_range: None,
        wrong_px,
        wrong_px_range: None,
        counts: Counts::default(),
        dominated_by: None,
    }
}

fn cloud(scene: &str, points: &[(&str, f64, f64)]) -> Cloud {
    let points = points.iter().map(|(name, ms, px)| named(name, *ms, *px));
    Cloud::new(Some(scene.to_owned()), points.collect())
}

#[test]
fn a_point_is_dominated_by_one_that_is_no_worse_in_both_and_better_in_one() {
    let cloud = cloud(
        "s",
        &[
            ("slow and exact", 9.0, 0.0),
            ("fast and wrong", 1.0, 50.0),
            ("twin of it", 1.0, 50.0),
            ("as fast, more wrong", 1.0, 51.0),
            ("as wrong, slower", 1.5, 50.0),
            ("between", 4.0, 3.0),
            ("slower and exact", 10.0, 0.0),
            ("beaten by beaten", 1.6, 60.0),
        ],
    );
    let by: Vec<Option<usize>> = cloud
        .points
        .iter()
        .map(|point| point.dominated_by)
        .collect();
    assert_eq!(
        by,
        [None, None, None, Some(1), Some(1), None, Some(0), Some(1)],
        "equal points leave each other alone; whoever dominates is on the front itself"
    );
    assert_eq!(cloud.front(), [1, 2, 5, 0]);
}

#[test]
fn the_mean_over_scenes_is_geometric_in_time_and_arithmetic_in_pixels() {
    let scenes = [
        cloud("a", &[("both", 2.0, 0.0), ("only here", 1.0, 0.0)]),
        cloud("b", &[("other", 1.0, 0.0), ("both", 8.0, 30.0)]),
    ];
    let all = overall(&scenes).unwrap();
    let [both] = all.points.as_slice() else {
        panic!("only those of every scene: {all:?}")
    };
    assert!((both.shadow_ms - 4.0).abs() < 1e-12, "{both:?}");
    assert_eq!(both.shadow_ms_range, Some((2.0, 8.0)));
    assert_eq!(both.wrong_px, 15.0);
    assert_eq!(both.wrong_px_range, Some((0.0, 30.0)));
    assert_eq!(both.dominated_by, None);

    assert!(overall(&scenes[..1]).is_none(), "one scene is no mean");
}

/// The rows of a table, each by its header.
fn table(path: &Path) -> Vec<HashMap<String, String>> {
    let mut reader = csv::Reader::from_path(path).unwrap();
    reader.deserialize().map(|row| row.unwrap()).collect()
}

#[test]
fn the_file_has_the_numbers_of_the_summary() {
    let dir = swept_run();
    let run = Run::read(dir.path()).unwrap();
    write(dir.path(), &clouds(&run)).unwrap();
    let summaries = table(&dir.path().join(SUMMARY_FILE));
    let rows = table(&dir.path().join(PARETO_FILE));
    let (overall, cells): (Vec<_>, Vec<_>) = rows.iter().partition(|row| row["scene"] == "*");
    assert_eq!(cells.len(), summaries.len());
    assert_eq!(overall.len() * 3, cells.len(), "three scenes");
    for (cell, summary) in cells.iter().zip(&summaries) {
        let both = cell.keys().filter(|name| summary.contains_key(*name));
        let mut same: Vec<&str> = both.map(String::as_str).collect();
        same.sort_unstable();
        assert_eq!(same.len(), 9, "{same:?}");
        for name in same {
            assert_eq!(cell[name], summary[name], "{name}: {cell:?}");
        }
        let number = |row: &HashMap<String, String>, name: &str| row[name].parse::<f64>().unwrap();
        let wrong = number(summary, "false_lit") + number(summary, "false_shadowed");
        let per_frame = wrong / number(summary, "verified_frames");
        assert_eq!(number(cell, "wrong_px_per_frame"), per_frame);
        assert_eq!(cell["front"] == "true", cell["dominated_by"].is_empty());
    }
}

#[test]
fn the_file_names_curves_and_dominators() {
    let dir = swept_run();
    let run = Run::read(dir.path()).unwrap();
    write(dir.path(), &clouds(&run)).unwrap();
    let rows = table(&dir.path().join(PARETO_FILE));
    let row = |method: &str, variant: &str| {
        let found = rows
            .iter()
            .find(|row| row["method"] == method && row["variant"] == variant);
        found.unwrap()
    };
    let swept = row("cube_shadow_map", "slope_bias=2,pcf=5");
    assert_eq!(swept["curve"], "cube_shadow_map slope_bias=2");
    assert_eq!(swept["swept_parameter"], "pcf");
    assert_eq!(swept["swept_value"], "5.0");
    assert_eq!(row("ray_query", "")["curve"], "");
    // As exact as the fastest exact one, and slower; the front has no other of no wrong pixel.
    assert_eq!(row("ray_query", "")["dominated_by"], "silhouette_ts");
    assert_eq!(row("silhouette_ts", "")["front"], "true");
}

#[test]
fn what_was_not_both_measured_and_verified_is_no_point() {
    let dir = swept_run();
    let mut run = Run::read(dir.path()).unwrap();
    let before = clouds(&run);
    run.summaries[0].status = Status::Unverified;
    run.summaries[1].shadow_ms_median = None;
    run.summaries[2].width += 1;
    let after = clouds(&run);
    assert_eq!(after[0].scene, None);
    for (before, after) in before.iter().zip(&after).take(2) {
        assert_eq!(
            after.points.len(),
            before.points.len() - 3,
            "of the scene and over all"
        );
    }
    run.summaries.clear();
    assert!(clouds(&run).is_empty());
}
