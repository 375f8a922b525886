//! Claims and verdicts.

use super::{compare, milet, milet_sheets, rows_like};
use crate::record::Summary;
use crate::report::fixture::paper_run;
use crate::report::paper::Paper;
use crate::report::paper::claims::{Check, SpeedUp};
use crate::report::paper::evidence::{Evidence, Finding, Verdict};
use crate::report::paper::sheet::Point;

fn finding<'a>(paper: &'a Paper, claim: &str) -> &'a Finding {
    let entry = paper.ledger.entries.iter().find(|e| e.claim.id == claim);
    &entry.unwrap().findings[1].1
}

fn verdicts(rows: &[Summary]) -> Vec<Verdict> {
    let paper = compare(&[paper_run("run", "A GPU", rows)]);
    let entries = paper.ledger.entries.iter();
    entries.map(|entry| entry.findings[1].1.verdict).collect()
}

#[test]
fn the_claims_recomputed_from_the_published_tables() {
    let sheets = milet_sheets();
    let evidence = Evidence {
        sheets: &sheets,
        group: None,
    };
    let found: Vec<Finding> = milet()
        .claims
        .iter()
        .map(|claim| claim.check.find(&evidence).unwrap())
        .collect();
    let texts: Vec<&str> = found.iter().map(|finding| finding.text.as_str()).collect();
    assert_eq!(
        texts,
        [
            "table 1: mean +14.3 %, at most +28.6 % (14 of 14); \
             table 2: mean +3.0 %, at most +27.0 % (30 of 30); all: mean +6.6 %",
            "table 1: mean +3.9 %, at most +8.3 % (14 of 14); \
             table 2: mean +1.7 %, at most +10.7 % (30 of 30); all: mean +2.4 %",
            "faster in 4 of 4, by factors of ×1.14 to ×2.00",
            "R9 280X: faster at 4 of 7 points, even at about 400,000 triangles; \
             GTX 680: faster at 4 of 7 points, even at about 520,000 triangles",
            "R9 280X: 25.5 %; GTX 680: 43.2 %",
            "faster in 4 of 4, by factors of ×1.14 to ×2.08",
            "R9 280X: TS silhouette over TS triangle ×4.09, on Sponza ×1.27; \
             GTX 680: TS silhouette over TS triangle ×4.05, on Sponza ×2.23; \
             R9 280X: GS silhouette over GS triangle ×10.97, on Sponza ×0.96; \
             GTX 680: GS silhouette over GS triangle ×3.02, on Sponza ×0.85"
        ]
    );
    assert!(
        found
            .iter()
            .all(|finding| finding.pairs == finding.pairs_of)
    );
    // What a note says of the Radeon: 34 % is table 3's, at the most triangles that it has.
    let share = evidence.ratios(3, ["ts_silhouette", "shadow_map_8k"], |at| {
        at.number == Some(1_960_000)
    });
    assert!((share.unwrap().list[0].ratio - 0.342).abs() < 0.001);
}

#[test]
fn every_claim_has_a_name_of_its_own_and_percentages_are_those_of_its_text() {
    let claims = &milet().claims;
    let mut ids: Vec<&str> = claims.iter().map(|claim| claim.id.as_str()).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), 7);
    for claim in claims {
        if let Check::SpeedUp(SpeedUp {
            mean_percent,
            max_percent,
            ..
        }) = claim.check
        {
            let said = format!("{mean_percent} % on average, up to {max_percent} %");
            assert_eq!(claim.claimed, said);
        }
    }
}

#[test]
fn a_device_like_the_papers_reproduces_every_claim() {
    let rows = rows_like("GTX 680", |_, _, _, fps| Some(fps * 7.0));
    assert_eq!(verdicts(&rows), [Verdict::Reproduced; 7]);
    let paper = compare(&[paper_run("run", "A GPU", &rows)]);
    assert_eq!(paper.sheets.len(), 4);
    let found = finding(&paper, "ts_silhouette_share_of_map");
    assert_eq!((found.value.unwrap() * 10.0).round(), 432.0);
}

#[test]
fn a_device_on_which_everything_is_smaller_shows_the_trend_only() {
    let rows = rows_like("GTX 680", |_, series, point, fps| {
        let sponza = point.id == "sponza";
        Some(match (series, point.id.as_str(), point.number) {
            // Speed-ups of 0.1 %.
            ("ts_consistent_triangle" | "gs_consistent_triangle", ..) => 50.0,
            // Silhouettes lose to the map from the start, more and more.
            ("ts_reference_edge" | "gs_reference_edge", ..) => 50.05,
            ("shadow_map_8k", _, Some(triangles)) => 60.0 + triangles as f64 / 1e6,
            ("ts_silhouette", "spheres_4m", _) => 70.0,
            // They gain on the large scene, but stay behind.
            ("ts_triangle", "spheres_4m", _) => 80.0,
            ("gs_triangle", "spheres_4m", _) => 30.0,
            ("gs_silhouette", "spheres_4m", _) => 25.0,
            ("ts_triangle", ..) if sponza => 40.0,
            ("ts_silhouette", ..) if sponza => 10.0,
            ("gs_triangle", ..) if sponza => 30.0,
            ("gs_silhouette", ..) if sponza => 10.0,
            _ => fps,
        })
    });
    let found = verdicts(&rows);
    use Verdict::{Reproduced, TrendOnly};
    assert_eq!(found[..2], [TrendOnly; 2]);
    assert_eq!(found[2], Reproduced);
    assert_eq!(found[3..5], [TrendOnly; 2]);
    assert_eq!(found[6], TrendOnly);
}

#[test]
fn a_device_that_is_the_other_way_round_contradicts_every_claim() {
    let rows = rows_like("GTX 680", |_, series, point, _| {
        Some(match (series, point.id.as_str(), point.number) {
            ("ts_consistent_triangle" | "gs_consistent_triangle", ..) => 60.0,
            ("shadow_map_8k", _, Some(triangles)) => 60.0 - triangles as f64 / 1e5,
            ("ts_triangle", ..) => 20.0,
            ("gs_triangle", ..) => 30.0,
            ("ts_silhouette" | "gs_silhouette", "spheres_4m", _) => 10.0,
            ("shadow_map_8k", ..) => 5.0,
            _ => 50.0,
        })
    });
    assert_eq!(verdicts(&rows), [Verdict::NotReproduced; 7]);
}

#[test]
fn a_verdict_says_on_how_little_it_rests() {
    let few = |table: u8, _: &str, point: &Point, fps: f64| {
        let kept = table == 1 && point.number.is_some_and(|number| number <= 102_400);
        kept.then_some(fps)
    };
    let mut rows = rows_like("R9 280X", few);
    rows[0].artifact_px = Some(9);
    let paper = compare(&[paper_run("run", "A GPU", &rows)]);
    assert_eq!(
        paper.sheets.len(),
        2,
        "tables 1 and 3 share their silhouettes"
    );
    let found = finding(&paper, "reference_edge_ts");
    assert_eq!((found.pairs, found.pairs_of, found.wrong_masks), (3, 22, 1));
    for claim in [
        "ts_silhouette_beats_map_up_to",
        "silhouettes_win_as_geometry_grows",
    ] {
        let found = finding(&paper, claim);
        assert_eq!((found.verdict, found.pairs), (Verdict::NotMeasured, 0));
    }
    let ledger = paper.ledger.markdown();
    assert!(ledger.contains("3 of 22, 1 with a wrong mask"), "{ledger}");
    assert!(!ledger.contains("say nothing about GPUs"));
}

#[test]
fn a_speed_up_in_table_2_alone_shows_the_trend_at_most() {
    let only_2 = |factor: f64| {
        move |table: u8, series: &str, _: &Point, _: f64| {
            let fps = if series.ends_with("edge") {
                50.0 * factor
            } else {
                50.0
            };
            (table == 2).then_some(fps)
        }
    };
    let first = |factor| verdicts(&rows_like("GTX 680", only_2(factor)))[0];
    assert_eq!(first(1.135), Verdict::TrendOnly);
    assert_eq!(first(0.9), Verdict::NotReproduced);
}

#[test]
fn a_software_device_is_called_one() {
    let rows = rows_like("GTX 680", |_, _, _, fps| Some(fps));
    let mut run = paper_run("run", "llvmpipe", &rows);
    run.info.device.device_type = "cpu".to_owned();
    let paper = compare(&[run]);
    let ledger = paper.ledger.markdown();
    assert!(ledger.contains("**llvmpipe** renders in software: its times say nothing about GPUs"));
    assert!(
        paper
            .ledger
            .csv()
            .unwrap()
            .contains("measured,llvmpipe,true,reproduced")
    );
}

#[test]
fn the_ledger_in_all_its_forms() {
    let rows = rows_like("GTX 680", |table, _, _, fps| {
        (table != 3).then_some(fps * 3.0)
    });
    let ledger = compare(&[paper_run("run", "A GPU", &rows)]).ledger;
    insta::assert_snapshot!("ledger_markdown", ledger.markdown());
    insta::assert_snapshot!("ledger_csv", ledger.csv().unwrap());
    let html = ledger.table().html().into_string();
    insta::assert_snapshot!("ledger_html", html.replace("><", ">\n<"));
}
