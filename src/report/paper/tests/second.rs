//! A second paper is a file and not code.

use crate::record::Cell;
use crate::report::fixture::{info, paper_row, paper_run};
use crate::report::groups::group;
use crate::report::paper::ledger::Ledger;
use crate::report::paper::published::Publication;
use crate::report::paper::{Paper, measured, numbers};

const PAPER: &str = r#"
short = "Nobody 2001"
authors = "Nobody"
title = "Made-Up Shadows"
year = 2001
quantity = "frame_ms"
prefix = "nobody_"
device = "Pentium III"

[[tables]]
number = 1
figure = 2
title = "Two methods in two towns"
points = "Town"
numbers = "none.csv"
series_columns = ["extraction"]
point_columns = ["scene", "triangles"]
series = ["brute_force", "tree"]
also = ["Port"]

[places."Old Town_1200"]
name = "Old Town, 1,200 triangles"
at = { scene = "old_town" }

[places."New Town_3400"]
name = "New Town, 3,400 triangles"
at = { scene = "new_town" }

[places.Port]
name = "Port, not in the paper"
at = { scene = "port" }

[series.brute_force]
name = "Brute force"
method = "silhouette_cpu"

[series.tree]
name = "Tree"
method = "silhouette_cpu"
needs = { name = "extraction", value = "tree", default = "brute_force" }

[[claims]]
id = "tree_wins"
text = "The tree is faster."
claimed = "in both towns"
[claims.check]
kind = "faster"
table = 1
series = "tree"
than = ["brute_force"]
scenes = ["Old Town_1200", "New Town_3400"]
"#;
const NUMBERS: &str = "\
scene,triangles,extraction,frame_ms
Old Town,1200,brute_force,4.5
Old Town,1200,tree,4.25
New Town,3400,brute_force,20
New Town,3400,tree,10
";

#[test]
fn a_file_gives_tables_and_a_ledger() {
    let paper: &'static Publication = Box::leak(Box::new(Publication::parse(PAPER).unwrap()));
    let row = |scene: &str, variant: &str, fps| {
        let cell = Cell {
            scene: scene.to_owned(),
            method: "silhouette_cpu".to_owned(),
            variant: variant.parse().unwrap(),
            width: info(&[], &[]).width,
            height: info(&[], &[]).height,
            ..Cell::default()
        };
        paper_row(&cell, fps, Some(0))
    };
    let rows = [
        row("old_town", "", 500.0),
        row("old_town", "extraction=tree", 400.0),
        row("new_town", "", 100.0),
        row("new_town", "extraction=tree", 200.0),
        row("port", "", 50.0),
        row("port", "extraction=tree", 40.0),
    ];
    let runs = [paper_run("run", "A GPU", &rows)];
    let groups = group(&runs, false).unwrap();
    let mut sheets = vec![numbers::sheet(paper, &paper.tables[0], NUMBERS).unwrap()];
    measured::fill(&mut sheets, &groups);
    let ledger = Ledger::new(paper, &sheets, &groups).unwrap();
    let paper = Paper {
        published: paper,
        sheets,
        ledger,
    };
    let files = paper.files().unwrap();
    let all: Vec<String> = files
        .iter()
        .map(|(name, text)| format!("{name}:\n{text}"))
        .collect();
    insta::assert_snapshot!(all.join("\n"));
}

#[test]
fn what_does_not_fit_is_named() {
    let error = Publication::parse(&PAPER.replace("\"tree\"]", "\"bush\"]")).unwrap_err();
    assert_eq!(
        error.to_string(),
        "table 1 names the series bush, which is none"
    );
    let paper: &'static Publication = Box::leak(Box::new(Publication::parse(PAPER).unwrap()));
    let fault = |from: &str, to: &str| {
        let numbers = NUMBERS.replacen(from, to, 1);
        numbers::sheet(paper, &paper.tables[0], &numbers)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        fault("Old Town", "Ghost Town"),
        "`Ghost Town_1200` is neither a number nor a known place"
    );
    assert_eq!(fault("tree,4.25", "bush,4.25"), "unknown: bush");
    assert_eq!(fault("4.25", "fast"), "`fast` is not a number");
    assert_eq!(fault("frame_ms", "ms"), "there is no column `frame_ms`");
    let lost = PAPER.replace("[\"Port\"]", "[\"Fort\"]");
    let paper: &'static Publication = Box::leak(Box::new(Publication::parse(&lost).unwrap()));
    assert_eq!(
        numbers::sheet(paper, &paper.tables[0], NUMBERS)
            .unwrap_err()
            .to_string(),
        "`Fort` is neither a number nor a known place"
    );
}
