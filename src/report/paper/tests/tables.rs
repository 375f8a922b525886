//! The tables' cells.

use super::{compare, milet, milet_sheets, place, rows_like};
use crate::record::{Cell, Summary, unique};
use crate::report::fixture::{paper_row, paper_run};
use crate::report::paper::sheet::{Mask, Point, Sheet};

/// A point of table 1.
fn triangles(number: u64) -> Point {
    let mut point = milet_sheets()[0].points[0].clone();
    point.number = Some(number);
    point.at.triangles = Some(number);
    point
}

#[test]
fn the_published_tables_have_all_their_cells() {
    let sheets = milet_sheets();
    let shape = |sheet: &Sheet| {
        let counts: Vec<usize> = sheet
            .columns
            .iter()
            .map(|column| column.cells.len())
            .collect();
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
fn cells_are_bold_marked_or_missing() {
    let at = |series, number| place(series, &triangles(number));
    let [consistent, edge, gs] = [
        "ts_consistent_triangle",
        "ts_reference_edge",
        "gs_consistent_triangle",
    ];
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
    let with = |variant: &str, number, fps| {
        let cell = Cell {
            variant: variant.parse().unwrap(),
            ..place("ts_reference_edge", &triangles(number))
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
    assert_eq!(column.variant(1).unwrap().as_str(), "input=storage");
    assert_eq!(column.value(1, 0).unwrap().value.round(), 2.0);
    assert_eq!(column.value(1, 1), None);
    let notes = paper.sheets[0].notes().join("\n");
    assert!(
        notes.contains("A GPU: TS reference edge with input=storage."),
        "{notes}"
    );
}

#[test]
fn only_the_8k_map_and_a_million_triangles_are_the_papers() {
    let map = &milet().series["shadow_map_8k"];
    assert!(map.is("shadow_map", &"slope_bias=3".parse().unwrap()));
    assert!(map.is("shadow_map", &"resolution=8192".parse().unwrap()));
    assert!(!map.is(
        "shadow_map",
        &"resolution=2048,slope_bias=3".parse().unwrap()
    ));
    let cube = &milet().series["cube_shadow_map"];
    assert!(cube.is("cube_shadow_map", &"resolution=1024".parse().unwrap()) && !cube.in_paper);

    let sheets = milet_sheets();
    let point = sheets[1]
        .points
        .iter()
        .find(|point| point.id == "25")
        .unwrap();
    let row = |triangles, objects| {
        let cell = Cell {
            triangles: Some(triangles),
            objects: Some(objects),
            ..place("ts_reference_edge", point)
        };
        paper_row(&cell, 1.0, None)
    };
    assert!(point.at.holds(&row(980_000, 25)));
    assert!(!point.at.holds(&row(40_000, 25)) && !point.at.holds(&row(980_000, 64)));
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
        assert!(sheet.columns[2].cells.iter().all(|cell| cell.run == "late"));
    }
}

#[test]
fn runs_that_share_no_cell_of_a_table_complete_each_other() {
    let scene = |wanted: &str| {
        rows_like("GTX 680", |table, _, point, fps| {
            (table == 4 && point.id == wanted).then_some(fps)
        })
    };
    let spheres = paper_run("spheres", "A GPU", &scene("spheres_4m"));
    let sponza = paper_run("sponza", "A GPU", &scene("sponza"));
    let paper = compare(&[sponza.clone(), spheres.clone()]);
    let column = paper.sheets[0].columns.last().unwrap();
    assert_eq!(column.cells.len(), 9);
    let csv = paper.sheets[0].csv().unwrap();
    assert_eq!(csv.matches(",spheres\n").count(), 5, "{csv}");
    assert_eq!(csv.matches(",sponza\n").count(), 4, "{csv}");
    let notes = paper.sheets[0].notes().join("\n");
    assert!(notes.contains("A GPU: from 2 runs"), "{notes}");

    let mut other = sponza;
    for row in &mut other.summaries {
        row.variant = "slope_bias=9".parse().unwrap();
    }
    let paper = compare(&[other, spheres]);
    let column = paper.sheets[0].columns.last().unwrap();
    let runs = column.cells.iter().map(|cell| cell.run.as_str());
    assert_eq!(unique(runs), ["spheres"], "a series has one variant");
}

#[test]
fn a_published_value_is_never_doubted() {
    let sheets = milet_sheets();
    let cells = sheets.iter().flat_map(|sheet| &sheet.columns);
    assert!(
        cells
            .flat_map(|column| &column.cells)
            .all(|cell| cell.mask == Mask::Published)
    );
    let line = sheets[1].markdown();
    assert!(
        line.contains("10.12") && line.contains("| 15,600"),
        "{line}"
    );
}

#[test]
fn a_table_of_every_layout() {
    let rows = rows_like("GTX 680", |table, _, point, fps| {
        let kept = table != 2 || point.number.is_some_and(|objects| objects < 25);
        kept.then_some(fps * 2.0)
    });
    let paper = compare(&[paper_run("run", "A GPU", &rows)]);
    for sheet in &paper.sheets[1..] {
        let table = format!("table{}", sheet.spec.number);
        insta::assert_snapshot!(format!("{table}_markdown"), sheet.markdown());
        insta::assert_snapshot!(format!("{table}_csv"), sheet.csv().unwrap());
    }
    let html = paper.sheets[2].table().html().into_string();
    insta::assert_snapshot!("table4_html", html.replace("><", ">\n<"));
}
