use super::fixture::{info, rows, write, write_picture};
use super::{MATRIX_FILE, StressRun};
use crate::record::stress::{
    DeclaredCause, Outcome, ROWS_FILE, STRESS_FILE, StressInfo, StressMethod,
};
use crate::report::{HTML_FILE, LegendEntry, write_stability};
use std::fs;
use tempfile::TempDir;

const LEGEND: [LegendEntry; 1] = [LegendEntry {
    label: "false lit, artifact",
    rgb: [255, 40, 30],
}];

fn room() -> TempDir {
    room_of(&info())
}

fn room_of(info: &StressInfo) -> TempDir {
    let room = tempfile::tempdir().unwrap();
    write(room.path(), info, &rows(info));
    room
}

fn page(room: &TempDir) -> String {
    write_stability(room.path(), &LEGEND).unwrap();
    fs::read_to_string(room.path().join(HTML_FILE)).unwrap()
}

fn error(room: &TempDir) -> String {
    format!("{:#}", StressRun::read(room.path()).unwrap_err())
}

#[test]
fn the_matrix_for_a_terminal() {
    let run = StressRun::read(room().path()).unwrap();
    let expected = "\
cause          1    2  3
calm           ·    ·  –
duplicated  257!  1+!  –
needles     1e-6    ·  –

1  triangle_ts,counting=z_pass,determinism=none
2  shadow_map
3  ray_query

A cell says the first value that fails. ! declared by no limit. +! undeclared at a later value. · never. – unavailable.
Of 18 pictures, 7 right, 3 wrong by a declared limit, 2 wrong undeclared, 6 unavailable.
";
    assert_eq!(run.matrix_text(), expected);
}

#[test]
fn the_matrix_as_markdown() {
    let run = StressRun::read(room().path()).unwrap();
    insta::assert_snapshot!(run.matrix_markdown());
}

#[test]
fn the_page_of_a_stress_run() {
    let page = page(&room());
    let (head, rest) = page.split_once("<style>").unwrap();
    let (_, body) = rest.split_once("</style>").unwrap();
    insta::assert_snapshot!(format!("{head}{body}").replace("><", ">\n<"));
}

#[test]
fn what_is_declared_and_does_not_show_is_told() {
    let declare = |cause: &str, from| DeclaredCause {
        cause: cause.to_owned(),
        from,
        limit: "<shaky>".to_owned(),
    };
    let mut info = info();
    // Right at 1, wrong at 257; wrong at once; right at all values; not tried from there on.
    info.methods[0].declared = vec![
        declare("duplicated", 1.0),
        declare("needles", 1e-6),
        declare("calm", 0.0),
        declare("calm", 0.5),
        declare("no such cause", 0.0),
    ];
    // Unavailable is no sign of anything.
    info.methods[2].declared = vec![declare("calm", 0.0)];
    let room = room_of(&info);
    let name = "triangle_ts,counting=z_pass,determinism=none";
    let lines = [
        format!("{name}: duplicated from 1, but right at 1, wrong from 257"),
        format!("{name}: calm from 0, but right at 0, and at every later value"),
    ];
    let run = StressRun::read(room.path()).unwrap();
    let text = run.matrix_text();
    assert_eq!(text.matches("declared, not seen: ").count(), 2, "{text}");
    let page = page(&room);
    let markdown = fs::read_to_string(room.path().join(MATRIX_FILE)).unwrap();
    for line in lines {
        assert!(
            text.contains(&format!("declared, not seen: {line}\n")),
            "{text}"
        );
        assert!(markdown.contains(&format!("- {line}\n")), "{markdown}");
    }
    assert_eq!(page.matches("&lt;shaky&gt;").count(), 2);
}

#[test]
fn undeclared_failures_are_counted() {
    let run = StressRun::read(room().path()).unwrap();
    let outcomes = [
        Outcome::Right,
        Outcome::Declared,
        Outcome::Undeclared,
        Outcome::Unavailable,
        Outcome::Failed,
    ];
    assert_eq!(outcomes.map(|outcome| run.count(outcome)), [7, 3, 2, 6, 0]);
}

#[test]
fn many_methods_make_several_narrow_blocks() {
    let mut info = info();
    info.methods = (0..60)
        .map(|index| StressMethod {
            id: format!("method_{index}"),
            variant: Default::default(),
            tolerated_share: 0.0,
            declared: Vec::new(),
        })
        .collect();
    let run = StressRun::read(room_of(&info).path()).unwrap();
    let text = run.matrix_text();
    assert!(text.lines().all(|line| line.chars().count() <= 120));
    let heads = text.lines().filter(|line| line.starts_with("cause"));
    assert_eq!(heads.count(), 3, "{text}");
}

#[test]
fn broken_rows_are_named_by_their_line() {
    let room = room();
    let path = room.path().join(ROWS_FILE);
    let text = fs::read_to_string(&path).unwrap();
    let broken = |from: &str, to: &str| {
        fs::write(&path, text.replacen(from, to, 1)).unwrap();
        error(&room)
    };
    let message = broken("calm,0.35,triangle_ts", "calm,much,triangle_ts");
    assert!(message.contains("stability.csv, line 5: "), "{message}");
    let message = broken("calm,0.35,triangle_ts", "storm,0.35,triangle_ts");
    assert!(message.ends_with("line 5: stability.json has no cause `storm`"));
    let message = broken("calm,0.35,shadow_map,", "calm,0.35,shadow_map,pcf=3");
    assert!(message.ends_with("line 6: stability.json has no method `shadow_map pcf=3`"));
    let message = broken("b.png", "../b.png");
    assert!(message.contains("`../b.png` is not the name of a picture"));
}

#[test]
fn broken_heads_are_named() {
    let room = room();
    let path = room.path().join(STRESS_FILE);
    fs::write(&path, "{\"format\": 99}").unwrap();
    assert!(error(&room).contains("has format 99"));
    fs::write(&path, "{").unwrap();
    assert!(error(&room).contains("stability.json is damaged"));
    fs::remove_file(&path).unwrap();
    assert!(
        error(&room).contains("is not the directory of a stress run: it has no stability.json")
    );
}

#[test]
fn an_interrupted_run_is_read_as_far_as_it_goes() {
    let mut info = info();
    info.complete = false;
    let room = room_of(&info);
    let path = room.path().join(ROWS_FILE);
    let text = fs::read_to_string(&path).unwrap();
    let end = text.find("calm,0.35,shadow_map").unwrap();
    fs::write(&path, &text[..end + 9]).unwrap();
    let run = StressRun::read(room.path()).unwrap();
    assert_eq!(run.rows.len(), 4);
    assert_eq!(run.warnings.len(), 1);
    let text = run.matrix_text();
    assert!(
        text.contains("\ncalm        ·  ·…  –\nduplicated\n"),
        "{text}"
    );
    let page = page(&room);
    assert!(page.contains("This run is still going, or was interrupted."));
    fs::remove_file(&path).unwrap();
    assert_eq!(StressRun::read(room.path()).unwrap().rows.len(), 0);
}

#[test]
fn the_page_escapes_what_the_run_says() {
    let page = page(&room());
    assert!(page.contains("Where it &lt;hurts&gt;"));
    assert!(page.contains("Nothing &lt;b&gt;much"));
    assert!(page.contains("a &lt;limit&gt;"));
    assert!(!page.contains("<b>much") && !page.contains("<limit>") && !page.contains("<hurts>"));
}

#[test]
fn missing_pictures_do_not_keep_the_page_from_being_written() {
    let room = room();
    // The first failure of each method and cause, and one that is undeclared later on.
    assert_eq!(page(&room).matches("The picture is missing.").count(), 4);
    write_picture(room.path());
    let page = page(&room);
    assert_eq!(page.matches("The picture is missing.").count(), 2);
    assert_eq!(page.matches("data:image/png;base64,").count(), 2);
}

#[test]
fn every_link_has_its_target() {
    let page = page(&room());
    let links: Vec<&str> = page
        .split("href=\"#")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    for link in &links {
        let target = format!("id=\"{link}\"");
        assert_eq!(page.matches(&target).count(), 1, "{link}");
    }
    for cell in [
        "cause-duplicated-1",
        "cause-duplicated-2",
        "cause-needles-1",
    ] {
        assert!(links.contains(&cell), "{cell}");
    }
}

#[test]
fn the_page_says_how_to_see_a_failure_again() {
    let page = page(&room());
    let command = "svbench render failures/needles_0.000001.toml \
        --method triangle_ts,counting=z_pass,determinism=none --size 8x6";
    assert!(page.contains(command));
    assert!(page.contains("hole 10, leak 2<"));
    assert!(page.contains("2 undeclared failures"));
    assert!(page.contains("false lit, artifact"));
}
