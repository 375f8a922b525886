use glam::{Vec3, Vec4};

use super::*;
use crate::scene::Light;
use std::fs;
use std::path::Path;

const GRID: &str = r#"title = "Two spheres"
[mesh]
kind = "sphere_grid"
rows = 1
columns = 2
slices = 8
[expect]
triangles = 128
objects = 2
[light]
position = [3, 20.0, 5.0]
[camera]
fov_deg = 60.0
near = 0.1
keys = [
  { time_s = 0.0, eye = [18, 12, 18], target = [0, 0, 0] },
  { time_s = 2.0, eye = [8, 2, 18], target = [0, 1, 0] },
]
"#;

fn obj_scene(mesh: &str) -> String {
    let (before, rest) = GRID.split_once("kind").unwrap();
    let (_, after) = rest.split_once("[light]").unwrap();
    format!("{before}kind = \"obj\"\n{mesh}\n[light]{after}")
}

fn error(text: &str) -> String {
    SceneFile::parse(text, "scenes/two.toml")
        .unwrap_err()
        .to_string()
}

/// The error after one edit of a good file.
fn error_after(from: &str, to: &str) -> String {
    assert!(GRID.contains(from));
    error(&GRID.replacen(from, to, 1))
}

#[test]
fn a_scene_file_becomes_a_scene() {
    let file = SceneFile::parse(GRID, "scenes/two.toml").unwrap();
    let scene = file.load(&ModelSearch::default()).unwrap();
    assert_eq!(
        (scene.name.as_str(), scene.title.as_str()),
        ("two", "Two spheres")
    );
    let light = Light::at(Vec4::new(3.0, 20.0, 5.0, 1.0));
    assert_eq!(scene.flight.at(1.0).light, light);
    assert_eq!(scene.flight.duration_s(), 2.0);
    assert_eq!(scene.flight.at(0.0).view.up, Vec3::Y);
    assert_eq!(scene.mesh_hash, scene.mesh.hash());
    let sun = GRID.replace("5.0]", "5.0]\nw = 0");
    assert_eq!(
        SceneFile::parse(&sun, "")
            .unwrap()
            .flight
            .at(0.0)
            .light
            .place
            .w,
        0.0
    );
}

#[test]
fn a_wrong_key_is_named_with_its_place_and_the_right_one() {
    assert!(
        error_after("colum", "colmu").starts_with("scenes/two.toml:5:1: unknown field `colmuns`"),
        "{}",
        error_after("colum", "colmu")
    );
    assert!(error_after("colum", "colmu").ends_with("did you mean `columns`?"));
    assert!(error_after("target", "tarket").ends_with("did you mean `target`?"));
    assert!(error_after("sphere_grid", "sphere_gird").ends_with("did you mean `sphere_grid`?"));
    assert!(error_after("[light]", "[lihgt]").ends_with("did you mean `light`?"));
}

#[test]
fn impossible_values_are_named_with_their_place() {
    let cases = [
        (
            "slices = 8",
            "slices = 9",
            ":3:8: a sphere needs an even number of slices",
        ),
        ("rows = 1", "", ":3:8: this kind of mesh needs `rows`"),
        (
            "rows = 1",
            "rows = 1\nup = \"y\"",
            ":5:6: `up` belongs to kind = \"obj\"",
        ),
        ("20.0", "nan", ":11:12: a light needs finite numbers"),
        ("5.0]", "5.0]\nw = 0.5", ":12:5: w must be 1"),
        (
            "[3, 20.0, 5.0]",
            "[0, 0, 0]\nw = 0",
            ":11:12: a direction towards the light",
        ),
        ("60.0", "180.0", ":13:11: the field of view"),
        ("0.1", "0.0", ":14:8: the near plane"),
        ("0.1", "inf", ":16:3: a camera needs finite numbers"),
        ("2.0", "0.0", ":17:3: the times of the camera's keys"),
        (
            "[18, 12, 18]",
            "[0, 0, 0]",
            ":16:3: the camera looks at the point where it is",
        ),
        (
            "[18, 12, 18]",
            "[0, 9, 0]",
            ":16:3: the camera looks along its up direction",
        ),
    ];
    for (from, to, message) in cases {
        let error = error_after(from, to);
        assert!(
            error.starts_with(&format!("scenes/two.toml{message}")),
            "{error}"
        );
    }
    let no_keys = GRID.split_once("keys").unwrap().0.to_owned() + "keys = []";
    assert!(error(&no_keys).contains(":15:8: a camera path needs at least one key"));
}

const KEYS: &str = "keys = [
  { time_s = 0.0, position = [3, 20.0, 5.0] },
  { time_s = 4.0, position = [0, 0, -2] },
]";

#[test]
fn a_light_may_move_through_keys() {
    let moving = |after: &str| GRID.replace("position = [3, 20.0, 5.0]", &format!("{KEYS}{after}"));
    let flight = |text: &str| SceneFile::parse(text, "two.toml").unwrap().flight;
    let lamp = flight(&moving(""));
    // Longer than the camera flies.
    assert_eq!(lamp.duration_s(), 4.0);
    assert_eq!(lamp.at(0.0).light.place, Vec4::new(3.0, 20.0, 5.0, 1.0));
    assert_eq!(lamp.at(2.0).light.place, Vec4::new(1.5, 10.0, 1.5, 1.0));
    assert_eq!(lamp.at(4.0).view, lamp.at(2.0).view);
    let sun = flight(&moving("\nw = 0"));
    assert_eq!(sun.at(0.0).light.place, Vec4::new(0.15, 1.0, 0.25, 0.0));
    assert_eq!(sun.at(4.0).light.place, Vec4::new(0.0, 0.0, -1.0, 0.0));
}

#[test]
fn an_impossible_light_path_is_named_with_its_place() {
    let error_of = |light: &str| error(&GRID.replace("position = [3, 20.0, 5.0]", light));
    let edited = |from: &str, to: &str| error_of(&KEYS.replacen(from, to, 1));
    for (error, expected) in [
        (
            edited("0.0,", "1.0,"),
            ":12:3: the times of the light's keys must begin at 0",
        ),
        (
            edited("4.0", "0.0"),
            ":13:3: the times of the light's keys must begin at 0",
        ),
        (
            edited("20.0", "inf"),
            ":12:30: a light needs finite numbers",
        ),
        (
            edited(" }", ", w = 0 }"),
            ":12:46: unknown field `w`, expected `time_s` or `position`",
        ),
        (
            error_of("keys = []"),
            ":11:8: a light path needs at least one key",
        ),
        (
            error_of("w = 1"),
            ":10:1: a light needs a `position`, `keys` to move through, or a `sun`",
        ),
        (
            error_of(&format!("position = [3, 20, 5]\n{KEYS}")),
            ":11:12: a light stands still at its `position` or moves through its `keys`",
        ),
        (
            error_of("position = [1, 2, 3]\nradius = 0.5"),
            ":12:1: unknown field `radius`",
        ),
        (
            error_of(&(KEYS.replace("-2", "0") + "\nw = 0")),
            ":13:30: a direction towards the light has length 0",
        ),
    ] {
        let expected = format!("scenes/two.toml{expected}");
        assert!(error.starts_with(&expected), "{error}\n{expected}");
    }
}

#[test]
fn what_was_expected_is_compared() {
    let file = SceneFile::parse(&GRID.replace("128", "129"), "two.toml").unwrap();
    let error = file.load(&ModelSearch::default()).unwrap_err().to_string();
    assert!(error.contains("says 129 triangles in 2 objects") && error.contains("has 128 in 2"));
}

#[test]
fn a_sphere_grid_can_be_chosen() {
    let file = SceneFile::parse(GRID, "two.toml").unwrap();
    let file = file.with_sphere_grid(Some(3), None, Some(10)).unwrap();
    assert_eq!(
        file.expect,
        Some(Expect {
            triangles: 600,
            objects: 6
        })
    );
    assert_eq!(file.title, "Sphere grid 3 × 2, 10 slices");
    let scene = file.clone().load(&ModelSearch::default()).unwrap();
    assert_eq!(scene.mesh.caster_triangle_count(), 600);
    assert!(matches!(
        file.with_sphere_grid(None, None, Some(7)),
        Err(SceneError::SphereGrid { .. })
    ));
}

#[test]
fn a_model_is_found_or_its_absence_explained() {
    let folder = tempfile::tempdir().unwrap();
    let text = obj_scene("file = \"one.obj\"\nup = \"z\"\nsource = \"the archive\"");
    let file = SceneFile::parse(&text, "one.toml").unwrap();
    let search = ModelSearch {
        folders: vec![folder.path().to_owned()],
    };
    let error = file.load(&search).unwrap_err();
    assert!(matches!(&error, SceneError::MissingModel { searched, .. } if searched.len() == 2));
    let text = error.to_string();
    let place = folder.path().join("one.obj").display().to_string();
    for part in [
        "model one.obj not found",
        &place,
        "where to get it: the archive",
        "SVBENCH_MODELS",
    ] {
        assert!(text.contains(part), "{text}");
    }

    fs::write(
        folder.path().join("one.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3",
    )
    .unwrap();
    let scene = file.load(&search).unwrap();
    assert_eq!(scene.mesh.corners(0)[2], Vec3::Y);
    assert!(matches!(
        file.with_sphere_grid(None, None, Some(8)),
        Err(SceneError::NotASphereGrid { .. })
    ));
    assert!(error_of_missing_up().contains("needs `up`"));
}

#[test]
fn receivers_are_named_and_cast_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let triangle = "f 1 2 3\n";
    let objects = ["wall", "ground", "wall", "tree"].map(|name| format!("o {name}\n{triangle}"));
    let text = format!("v 0 0 0\nv 1 0 0\nv 0 0 1\n{}", objects.concat());
    fs::write(folder.path().join("one.obj"), text).unwrap();
    let search = ModelSearch {
        folders: vec![folder.path().to_owned()],
    };
    let file = |receivers: &str| {
        let mesh = format!("file = \"one.obj\"\nup = \"y\"\nreceivers = {receivers}");
        SceneFile::parse(&obj_scene(&mesh), "scenes/one.toml")
    };
    let scene = file("[\"wall\", \"ground\"]").unwrap().load(&search);
    let mesh = scene.unwrap().mesh;
    let casts: Vec<_> = mesh.objects.iter().map(|o| o.casts_shadow).collect();
    assert_eq!(casts, [false, false, false, true]);

    let unknown = file("[\n  \"wall\",\n  \"gruond\",\n]").unwrap();
    assert_eq!(
        unknown.load(&search).unwrap_err().to_string(),
        "scenes/one.toml:8:3: the model has no object `gruond`; did you mean `ground`?"
    );
    let twice = file("[\"wall\", \"wall\"]").unwrap_err().to_string();
    assert_eq!(twice, "scenes/one.toml:6:22: `wall` stands here twice");
    let grid = error_after("rows = 1", "rows = 1\nreceivers = []");
    assert!(grid.starts_with("scenes/two.toml:5:13: `receivers` belongs to kind = \"obj\""));
}

fn error_of_missing_up() -> String {
    error(&obj_scene("file = \"one.obj\""))
}

#[test]
fn a_bare_model_is_framed_and_lit_from_above() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("one.obj");
    fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3").unwrap();
    let scene = Scene::from_obj(&path, Up::Y).unwrap();
    assert_eq!(
        (scene.name.as_str(), scene.flight.camera.validate()),
        ("one", Ok(()))
    );
    assert!(scene.flight.at(0.0).light.place.y > 1.0);
}

#[test]
fn the_scene_files_of_the_project_are_valid() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let file = SceneFile::read(&path).unwrap();
            assert!(file.expect.is_some(), "{}: no [expect]", path.display());
            assert!(
                file.flight.camera.keys.len() > 1,
                "{}: a still",
                path.display()
            );
        }
    }
}
