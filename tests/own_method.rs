//! A method from outside of the crate in a whole run: examples/own_method.rs.

#[path = "../examples/own_method.rs"]
mod own_method;

use clap::Parser;
use svbench::cli::Cli;
use svbench::record::{Status, Summary};

fn svbench(arguments: &[&str]) -> anyhow::Result<()> {
    let line = ["svbench"].iter().chain(arguments);
    Cli::try_parse_from(line)
        .expect("a command line")
        .execute(&own_method::registry())
}

#[test]
fn a_run_with_it_has_its_rows_and_its_shadows() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("run");
    let out_text = out.to_str().unwrap();
    svbench(&["run", "examples/own_method.toml", "--out", out_text]).unwrap();
    let mut table = csv::Reader::from_path(out.join("summary.csv")).unwrap();
    let rows: Vec<Summary> = table.deserialize().map(|row| row.unwrap()).collect();
    let of = |method: &str, variant: &str| {
        let is_it = |row: &&Summary| row.method == method && row.variant.as_str() == variant;
        let row = rows.iter().find(is_it).expect("a row of each method");
        assert_eq!((row.status, row.reason.as_str()), (Status::Ok, ""));
        assert_eq!(row.frames, 4);
        row
    };
    let wrong = |row: &Summary| row.artifact_px.unwrap() + row.boundary_px.unwrap();
    let (whole, half) = (of("sphere_shadow", ""), of("sphere_shadow", "scale=0.5"));
    // The objects are spheres: only the corners of their triangles are elsewhere.
    assert!(wrong(whole) < 320 * 240 / 100, "{} pixels", wrong(whole));
    assert!(wrong(half) > 5 * wrong(whole), "{} pixels", wrong(half));
    of("shadow_map", "resolution=1024");
}

#[test]
fn its_parameter_has_a_range() {
    for (method, part) in [
        ("sphere_shadow,scale=0", "from 0.1 to 10"),
        ("sphere_shadow,size=1", "expected one of `scale`"),
        ("sphere_shadw", "did you mean `sphere_shadow`?"),
    ] {
        let error = svbench(&["render", "sphere_grid", "--method", method]).unwrap_err();
        assert!(error.to_string().contains(part), "{error}");
    }
}
