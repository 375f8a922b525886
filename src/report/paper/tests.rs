//! Tables and ledger over the published numbers and over made-up runs.

use super::check::{Finding, Verdict};
use super::claims::{Check, claims};
use super::evidence::Evidence;
use super::sheet::{Mask, Sheet, Source};
use super::spec::{Place, Point};
use super::{Paper, published};
use crate::bench::record::{Cell, Summary};
use crate::report::fixture::{info, paper_row, paper_run};
use crate::report::groups::group;
use crate::report::load::Run;

/// Where the cell of a series at a point is measured.
fn place(series: &super::spec::Series, point: Point) -> Cell {
    let (scene, triangles, objects) = match point {
        Point::Triangles(triangles) => ("sphere_grid_n1", triangles, 100),
        Point::Objects(objects) => ("sphere_objects_1x1_n1", 983_756, objects),
        Point::Scene(Place::Spheres4M) => ("sphere_grid_n200", 4_000_000, 100),
        Point::Scene(Place::Sponza) => ("sponza", 262_267, 381),
    };
    let consistent = series.determinism == "consistent_triangle";
    Cell {
        scene: scene.to_owned(),
        triangles: Some(triangles),
        objects: Some(objects),
        method: series.method.to_owned(),
        variant: if consistent {
            "determinism=consistent_triangle".to_owned()
        } else {
            String::new()
        },
        width: info(&[], &[]).width,
        height: info(&[], &[]).height,
        counters: String::new(),
    }
}

/// Rows with the numbers of a published device, as `change` changes them; `None` leaves one out.
fn rows_like(device: &str, change: impl Fn(u8, &str, Point, f64) -> Option<f64>) -> Vec<Summary> {
    let mut rows: Vec<Summary> = Vec::new();
    for sheet in published::sheets().unwrap() {
        let column = sheet.columns.iter().find(|c| c.device == device).unwrap();
        for (series, what) in sheet.spec.series.iter().enumerate() {
            for (at, point) in sheet.points.iter().enumerate() {
                let cell = column.cell(series, at);
                let fps = cell.and_then(|c| change(sheet.spec.number, what.id, *point, c.fps));
                let cell = place(what, *point);
                let known = |row: &Summary| {
                    (
                        &row.scene,
                        row.triangles,
                        row.objects,
                        &row.method,
                        &row.variant,
                    ) == (
                        &cell.scene,
                        cell.triangles,
                        cell.objects,
                        &cell.method,
                        &cell.variant,
                    )
                };
                if let (Some(fps), false) = (fps, rows.iter().any(known)) {
                    rows.push(paper_row(&cell, fps, Some(0)));
                }
            }
        }
    }
    rows
}

fn compare(runs: &[Run]) -> Paper {
    Paper::compare(&group(runs, false).unwrap())
        .unwrap()
        .unwrap()
}

fn finding<'a>(paper: &'a Paper, claim: &str) -> &'a Finding {
    let entry = paper.ledger.entries.iter().find(|e| e.claim.id == claim);
    &entry.unwrap().devices[0].1
}

fn verdicts(rows: &[Summary]) -> Vec<Verdict> {
    let paper = compare(&[paper_run("run", "A GPU", rows)]);
    let entries = paper.ledger.entries.iter();
    entries.map(|entry| entry.devices[0].1.verdict).collect()
}

#[test]
fn the_published_tables_have_all_their_cells() {
    let sheets = published::sheets().unwrap();
    let shape = |sheet: &Sheet| {
        let counts: Vec<usize> = sheet.columns.iter().map(|column| column.count()).collect();
        (sheet.points.len(), sheet.spec.series.len(), counts)
    };
    let shapes: Vec<_> = sheets.iter().map(shape).collect();
    // Table 4 has no shadow map on Sponza, and the cube map is not the paper's.
    assert_eq!(
        shapes,
        [
            (7, 4, vec![28, 28]),
            (15, 4, vec![60, 60]),
            (7, 2, vec![14, 14]),
            (2, 6, vec![9, 9])
        ]
    );
}

#[test]
fn the_claims_recomputed_from_the_published_tables() {
    let sheets = published::sheets().unwrap();
    let evidence = Evidence {
        sheets: &sheets,
        source: Source::Paper,
    };
    let found: Vec<Finding> = claims()
        .unwrap()
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
        at == Point::Triangles(1_960_000)
    });
    assert!((share.unwrap().list[0].ratio - 0.342).abs() < 0.001);
}

#[test]
fn every_claim_has_a_name_of_its_own_and_percentages_are_those_of_its_text() {
    let claims = claims().unwrap();
    let mut ids: Vec<&str> = claims.iter().map(|claim| claim.id.as_str()).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), 7);
    for claim in &claims {
        if let Check::SpeedUp {
            mean_percent,
            max_percent,
            ..
        } = claim.check
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
        let sponza = point == Point::Scene(Place::Sponza);
        Some(match (series, point) {
            // Speed-ups of 0.1 %.
            ("ts_consistent_triangle" | "gs_consistent_triangle", _) => 50.0,
            // Silhouettes lose to the map from the start, more and more.
            ("ts_reference_edge" | "gs_reference_edge", Point::Objects(_)) => 50.05,
            ("ts_reference_edge", Point::Triangles(_)) => 50.05,
            ("gs_reference_edge", Point::Triangles(_)) => 50.05,
            ("shadow_map_8k", Point::Triangles(triangles)) => 60.0 + triangles as f64 / 1e6,
            ("ts_silhouette", Point::Scene(Place::Spheres4M)) => 70.0,
            // They gain on the large scene, but stay behind.
            ("ts_triangle", Point::Scene(Place::Spheres4M)) => 80.0,
            ("gs_triangle", Point::Scene(Place::Spheres4M)) => 30.0,
            ("gs_silhouette", Point::Scene(Place::Spheres4M)) => 25.0,
            ("ts_triangle", _) if sponza => 40.0,
            ("ts_silhouette", _) if sponza => 10.0,
            ("gs_triangle", _) if sponza => 30.0,
            ("gs_silhouette", _) if sponza => 10.0,
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
        let large = matches!(point, Point::Scene(Place::Spheres4M));
        Some(match (series, point) {
            ("ts_consistent_triangle" | "gs_consistent_triangle", _) => 60.0,
            ("shadow_map_8k", Point::Triangles(triangles)) => 60.0 - triangles as f64 / 1e5,
            ("ts_triangle", _) => 20.0,
            ("gs_triangle", _) => 30.0,
            ("ts_silhouette" | "gs_silhouette", Point::Scene(_)) if large => 10.0,
            ("shadow_map_8k", _) => 5.0,
            _ => 50.0,
        })
    });
    assert_eq!(verdicts(&rows), [Verdict::NotReproduced; 7]);
}

#[test]
fn a_verdict_says_on_how_little_it_rests() {
    let few = |table: u8, _: &str, point: Point, fps: f64| {
        let kept = table == 1 && point.number().is_some_and(|number| number <= 102_400);
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
        move |table: u8, series: &str, _: Point, _: f64| {
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
fn cells_are_bold_marked_or_missing() {
    let sheets = published::sheets().unwrap();
    let [consistent, edge, gs, _] = sheets[0].spec.series else {
        panic!("four series")
    };
    let at = |series, triangles| place(series, Point::Triangles(triangles));
    let mut cut_short = paper_row(&at(gs, 67_600), 70.0, Some(0));
    cut_short.frames = 2;
    let other_count = Cell {
        triangles: Some(6400),
        ..at(edge, 0)
    };
    let rows = [
        paper_row(&at(consistent, 32_400), 40.0, Some(0)),
        paper_row(&at(edge, 32_400), 30.0, Some(0)),
        paper_row(&at(gs, 32_400), 50.0, Some(7)),
        paper_row(&at(consistent, 67_600), 9.0, None),
        paper_row(&at(edge, 67_600), 8.0, Some(0)),
        cut_short,
        paper_row(&at(edge, 102_400), 8.0, Some(0)),
        paper_row(&other_count, 99.0, Some(0)),
    ];
    let runs = [
        paper_run("a", "A GPU", &rows),
        paper_run("b", "B GPU", &rows[..2]),
    ];
    let paper = compare(&runs);
    let table = paper.sheets[0].markdown();
    let row = |name: &str| {
        let line = table
            .lines()
            .find(|line| line.starts_with(&format!("| {name}")));
        let cells = line.unwrap().split('|').skip(10).map(str::trim);
        cells.take(8).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(
        row("32,400"),
        [
            "**40.0**", "30.0", "50.0†", "–", "**40.0**", "30.0", "–", "–"
        ]
    );
    assert_eq!(
        row("67,600"),
        ["9.00‡", "**8.00**", "70.0§", "–", "–", "–", "–", "–"]
    );
    assert_eq!(row("102,400")[1], "8.00", "without a rival nothing is best");
    assert!(
        !table.contains("6,400 |"),
        "the paper lacks this row: {table}"
    );
    for mark in ["†", "‡", "§"] {
        assert!(table.contains(&format!("- {mark}: ")), "{table}");
    }
    let csv = paper.sheets[0].csv().unwrap();
    let mut rows = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 7 * 4 * 4);
    let wrong = rows.iter().find(|row| &row[10] == "wrong").unwrap();
    assert_eq!(
        (&wrong[0], &wrong[1], &wrong[8], &wrong[9]),
        ("measured", "A GPU", "50.0", "false")
    );
}

#[test]
fn a_series_has_one_variant_the_first_of_the_run_that_was_measured() {
    let sheets = published::sheets().unwrap();
    let edge = &sheets[0].spec.series[1];
    let with = |variant: &str, triangles, fps| {
        let cell = Cell {
            variant: variant.to_owned(),
            ..place(edge, Point::Triangles(triangles))
        };
        paper_row(&cell, fps, Some(0))
    };
    let rows = [
        with("determinism=none", 32_400, 1.0),
        with("input=storage", 32_400, 2.0),
        with("input=patch", 32_400, 3.0),
        with("input=patch", 67_600, 4.0),
    ];
    let paper = compare(&[paper_run("run", "A GPU", &rows)]);
    let column = paper.sheets[0].columns.last().unwrap();
    assert_eq!(column.variants[1], "input=storage");
    assert_eq!(column.cell(1, 0).unwrap().fps.round(), 2.0);
    assert_eq!(column.cell(1, 1), None);
    let notes = paper.sheets[0].notes().join("\n");
    assert!(
        notes.contains("A GPU: TS reference edge with input=storage."),
        "{notes}"
    );
}

#[test]
fn only_the_8k_map_and_a_million_triangles_are_the_papers() {
    let sheets = published::sheets().unwrap();
    let map = &sheets[2].spec.series[1];
    assert!(map.is("shadow_map", "slope_bias=3"));
    assert!(map.is("shadow_map", "resolution=8192"));
    assert!(!map.is("shadow_map", "resolution=2048,slope_bias=3"));
    let cube = &sheets[3].spec.series[5];
    assert!(cube.is("cube_shadow_map", "resolution=1024") && !cube.in_paper);

    let edge = &sheets[1].spec.series[1];
    let row = |triangles, objects| {
        let cell = Cell {
            triangles: Some(triangles),
            objects: Some(objects),
            ..place(edge, Point::Objects(25))
        };
        paper_row(&cell, 1.0, None)
    };
    let point = Point::Objects(25);
    assert!(point.holds(&row(980_000, 25)));
    assert!(!point.holds(&row(40_000, 25)) && !point.holds(&row(980_000, 64)));
}

#[test]
fn table_2_shows_what_recording_takes() {
    let rows = rows_like("GTX 680", |table, _, _, fps| (table == 2).then_some(fps));
    let paper = compare(&[paper_run("run", "A GPU", &rows)]);
    let [table] = paper.sheets.as_slice() else {
        panic!("one table")
    };
    assert!(table.markdown().contains("**134** (0.500 ms, 12 draws)"));
    let old: Vec<Summary> = rows
        .into_iter()
        .map(|row| Summary {
            record_ms_median: None,
            draw_calls: Some(0),
            ..row
        })
        .collect();
    let paper = compare(&[paper_run("run", "A GPU", &old)]);
    assert!(!paper.sheets[0].markdown().contains("draws"));
}

#[test]
fn the_numbers_of_a_table_come_from_the_fullest_run_and_of_equals_from_the_latest() {
    let full = rows_like("GTX 680", |_, _, _, _| Some(10.0));
    let mut early = paper_run("early", "A GPU", &full);
    early.info.started = "2026-03-09T14:05:06+09:00".to_owned();
    let mut late = paper_run("late", "A GPU", &full);
    late.info.started = "2026-03-09T14:05:06Z".to_owned();
    let part = paper_run("part", "A GPU", &full[..3]);
    let paper = compare(&[part, late, early]);
    for sheet in &paper.sheets {
        assert_eq!(sheet.columns.len(), 3);
        assert_eq!(sheet.columns[2].runs, ["late"]);
    }
}

#[test]
fn runs_that_share_no_cell_of_a_table_complete_each_other() {
    let scene = |wanted: Place| {
        rows_like("GTX 680", move |table, _, point, fps| {
            (table == 4 && point == Point::Scene(wanted)).then_some(fps)
        })
    };
    let spheres = paper_run("spheres", "A GPU", &scene(Place::Spheres4M));
    let sponza = paper_run("sponza", "A GPU", &scene(Place::Sponza));
    let paper = compare(&[sponza.clone(), spheres.clone()]);
    let column = paper.sheets[0].columns.last().unwrap();
    assert_eq!((column.count(), column.runs.len()), (9, 2));
    let csv = paper.sheets[0].csv().unwrap();
    assert_eq!(csv.matches(",spheres\n").count(), 5, "{csv}");
    assert_eq!(csv.matches(",sponza\n").count(), 4, "{csv}");
    let notes = paper.sheets[0].notes().join("\n");
    assert!(notes.contains("A GPU: from 2 runs"), "{notes}");

    let mut other = sponza;
    for row in &mut other.summaries {
        row.variant = "slope_bias=9".to_owned();
    }
    let paper = compare(&[other, spheres]);
    let column = paper.sheets[0].columns.last().unwrap();
    assert_eq!(column.runs, ["spheres"], "a series has one variant");
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
fn a_published_value_is_never_doubted() {
    let sheets = published::sheets().unwrap();
    let cells = sheets.iter().flat_map(|sheet| &sheet.columns);
    let mut cells = cells.flat_map(|column| column.cells.iter().flatten().flatten());
    assert!(cells.all(|cell| cell.mask == Mask::Published));
    let line = sheets[1].markdown();
    assert!(
        line.contains("10.12") && line.contains("| 15,600"),
        "{line}"
    );
}
