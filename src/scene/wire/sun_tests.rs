use crate::scene::{Flight, LightPath, Mesh, ModelSearch, Part, Scene, SceneFile, export};
use glam::Vec3;

/// The lines count: messages name them.
const SCENE: &str = r#"title = "Day"
[mesh]
kind = "sphere_grid"
rows = 1
columns = 1
slices = 4
[light.sun]
latitude = 48.2
longitude = 16.37
date = "2026-09-18"
zone = "Europe/Vienna"
from = "09:00"
to = "17:00"
[camera]
fov_deg = 60.0
near = 0.1
keys = [
  { time_s = 0.0, eye = [18.0, 12.0, 18.0], target = [0.0, 0.0, 0.0] },
  { time_s = 16.0, eye = [6.0, 10.0, 16.0], target = [1.0, 0.0, -1.0] },
]
"#;

fn flight(text: &str) -> Flight {
    SceneFile::parse(text, "day.toml").unwrap().flight
}

#[track_caller]
fn edited(from: &str, to: &str) -> String {
    assert!(SCENE.contains(from), "{from}");
    SCENE.replacen(from, to, 1)
}

#[test]
fn a_sun_takes_as_long_as_the_camera_or_as_it_is_said() {
    let day = flight(SCENE);
    assert_eq!((day.duration_s(), day.light.duration_s()), (16.0, 16.0));
    assert_eq!(day.at(3.0).light.place.w, 0.0);
    assert_eq!(day.check_times(day.frame_times(100).into_iter()), Ok(()));
    // In the morning in the east, x, and in the afternoon in the west.
    assert!(day.at(0.0).light.place.x > 0.5 && day.at(16.0).light.place.x < -0.5);
    let short = flight(&edited("[camera]", "duration_s = 4\n[camera]"));
    assert_eq!(short.light.duration_s(), 4.0);
    assert_eq!(short.at(4.0).light, day.at(16.0).light);
    let noon = edited("from = \"09:00\"\nto = \"17:00\"", "time = \"12:48:30\"");
    let noon = flight(&noon);
    assert_eq!(noon.light.duration_s(), 0.0);
    let south = noon.at(5.0).light.place;
    assert!(south.x.abs() < 0.01 && south.z > 0.7, "{south}");
    let turned = edited("[camera]", "north = [1, 0, 0]\n[camera]");
    let turned = turned.replace("from = \"09:00\"\nto = \"17:00\"", "time = \"12:48:30\"");
    let turned = flight(&turned).at(0.0).light.place;
    assert!(turned.z.abs() < 0.01 && turned.x < -0.7, "{turned}");
}

#[test]
fn an_impossible_sun_is_named_with_its_place() {
    let error = |text: &str| SceneFile::parse(text, "day.toml").unwrap_err().to_string();
    for (from, to, expected) in [
        ("48.2", "90.5", ":8:12: a latitude is from -90 to 90"),
        ("16.37", "-181", ":9:13: a longitude is from -180 to 180"),
        ("2026-09-18", "2026-02-30", ":10:8: there is no 2026-02-30"),
        (
            "2026-09-18",
            "3500-01-01",
            ":10:8: the sun's place is known",
        ),
        ("2026-09-18", "2026-03-29", ""),
        ("Europe/Vienna", "Europe/Wienna", ":11:8: unknown time zone"),
        (
            "Europe/Vienna",
            "Europe/Wienna",
            "did you mean `Europe/Vienna`?",
        ),
        ("09:00", "9 h", ":12:8: `9 h` is not a time of day"),
        ("09:00", "04:00", ":12:8: at 04:00 on 2026-09-18 the sun is"),
        ("09:00", "04:00", "rises at 06:37 and sets at 18:59"),
        ("17:00", "08:59", ":13:6: 08:59:00 is before 09:00:00"),
        (
            "17:00",
            "22:00",
            ":12:8: the sun sets at 18:59, before the end",
        ),
        (
            "to = \"17:00\"\n",
            "",
            ":7:1: a sun stands still at a `time`, or goes",
        ),
        (
            "[camera]",
            "north = [0, 2, 0]\n[camera]",
            ":14:9: north and up lie on one line",
        ),
        (
            "[camera]",
            "up = [0, 0, 0]\n[camera]",
            ":14:6: up must be a direction",
        ),
        (
            "[camera]",
            "duration_s = 0\n[camera]",
            ":14:14: the sun needs a time on the flight",
        ),
        (
            "[light.sun]",
            "[light]\nw = 0\n[light.sun]",
            "remove `position`, `keys` and `w`",
        ),
        (
            "[camera]",
            "height = 1\n[camera]",
            ":14:1: unknown field `height`",
        ),
        (
            "  { time_s = 16.0, eye = [6.0, 10.0, 16.0], target = [1.0, 0.0, -1.0] },\n",
            "",
            ":7:1: the camera stands still, so the sun needs `duration_s`",
        ),
    ] {
        if expected.is_empty() {
            flight(&edited(from, to));
            continue;
        }
        let error = error(&edited(from, to));
        assert!(error.contains(expected), "{error}\n{expected}");
        assert!(error.starts_with("day.toml:"), "{error}");
    }
    let polar = edited("48.2", "69.65").replace("2026-09-18", "2026-12-21");
    let polar = error(&polar);
    assert!(polar.contains("that day it does not rise"), "{polar}");
    let skipped = edited("2026-09-18", "2026-03-29").replace("09:00", "02:30");
    let skipped = error(&skipped);
    assert!(
        skipped.contains(":12:8: on 2026-03-29 clocks in Europe/Vienna do not show"),
        "{skipped}"
    );
}

#[test]
fn a_sun_is_written_and_read_back() {
    let triangle = [Vec3::ZERO, Vec3::X, Vec3::Z];
    let mesh: Mesh = [Part::of_triangles("one", &[triangle])]
        .into_iter()
        .collect();
    for text in [
        SCENE.to_owned(),
        edited("from = \"09:00\"\nto = \"17:00\"", "time = \"12:48:30.25\""),
        edited(
            "[camera]",
            "north = [0.1, 1e-300, -3]\nup = [0, 2, 0]\n[camera]",
        ),
        edited("Europe/Vienna", "+02:00"),
    ] {
        let flight = flight(&text);
        let scene = Scene::new(
            "day".to_owned(),
            "Day".to_owned(),
            mesh.clone(),
            flight.clone(),
        );
        let folder = tempfile::tempdir().unwrap();
        let path = export::write(&scene, folder.path(), "day").unwrap();
        let read = SceneFile::read(&path)
            .unwrap()
            .load(&ModelSearch::for_scene_file(&path))
            .unwrap();
        assert_eq!(read.flight, flight);
        assert!(matches!(read.flight.light, LightPath::Sun(_)));
    }
}
