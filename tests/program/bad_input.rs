//! What the program says to bad input: the exit code, the place, what to do; and that it leaves
//! nothing behind.

use std::fs;
use std::path::Path;
use std::process::Command;
use svbench::record::{Status, Summary};
use tempfile::TempDir;

/// Exit code for a wrong command line or configuration.
const USAGE: i32 = 2;
/// Exit code for everything else that went wrong.
const FAILED: i32 = 1;

const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const SMALL_MAP: &str = "shadow_map,resolution=64";
const PICTURES: [&str; 4] = ["mask", "out", "reference", "error"];

/// The lines count: messages name them.
const CONFIG: &str = r#"title = "Bad input"
size = [64, 48]
frames = 1
warmup_frames = 0
verified_frames = 1
seed = 1

[[scenes]]
scene = "sphere_grid"
slices = 8

[[methods]]
id = "shadow_map"
resolution = 64
"#;

/// Refers to `model.obj` in its folder.
const SCENE: &str = r#"title = "Triangle"

[mesh]
kind = "obj"
file = "model.obj"
up = "y"

[expect]
triangles = 1
objects = 1

[light]
position = [3.0, 20.0, 5.0]

[camera]
fov_deg = 60.0
near = 0.1
keys = [
  { time_s = 0.0, eye = [0.3, 0.3, 3.0], target = [0.0, 0.0, 0.0] },
  { time_s = 1.0, eye = [0.6, 0.3, 3.0], target = [0.0, 0.0, 0.0] },
]
"#;

/// Exit code and streams of one call.
struct Said {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

impl Said {
    /// Asserts a failure whose message has all these parts.
    #[track_caller]
    fn fails(&self, code: i32, parts: &[&str]) {
        let Self { stdout, stderr, .. } = self;
        assert_eq!(self.code, Some(code), "{stdout}\n{stderr}");
        for part in parts {
            assert!(stderr.contains(part), "no `{part}` in: {stderr}");
        }
    }
}

/// A folder of its own in which the program runs.
struct Room(TempDir);

impl Room {
    fn new() -> Self {
        Self(tempfile::tempdir().expect("a folder for temporary files"))
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> &Self {
        fs::write(self.path().join(name), contents).expect("a writable folder");
        self
    }

    fn has(&self, name: &str) -> bool {
        self.path().join(name).exists()
    }

    fn svbench<'a>(&self, args: impl IntoIterator<Item = &'a str>) -> Said {
        let output = Command::new(env!("CARGO_BIN_EXE_svbench"))
            .args(args)
            .current_dir(self.path())
            .env("SVBENCH_CACHE", "")
            .env_remove("SVBENCH_MODELS")
            .output()
            .expect("the program starts");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let said = Said {
            code: output.status.code(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        };
        assert!(!said.stderr.contains("panicked"), "{}", said.stderr);
        said
    }

    /// `svbench run run.toml --out out`, and more arguments.
    fn run(&self, more: &[&str]) -> Said {
        let args = ["run", "run.toml", "--out", "out"];
        self.svbench(args.iter().chain(more).copied())
    }

    /// A small `svbench render SCENE` with all its pictures, and more arguments.
    fn render(&self, scene: &str, method: &str, more: &[&str]) -> Said {
        let mut args = vec!["render", scene, "--method", method, "--size=64x48"];
        let pictures = PICTURES.map(|name| format!("--{name}={name}.png"));
        args.extend(
            pictures
                .iter()
                .map(String::as_str)
                .chain(more.iter().copied()),
        );
        let said = self.svbench(args);
        let good = said.code == Some(0);
        for name in PICTURES {
            assert_eq!(self.has(&format!("{name}.png")), good, "{name}.png");
        }
        said
    }

    /// Status and reason of every cell in the run directory `out`.
    fn cells(&self) -> Vec<(Status, String)> {
        let path = self.path().join("out/summary.csv");
        let mut table = csv::Reader::from_path(path).expect("a summary");
        let rows = table.deserialize().map(|row| row.expect("a whole row"));
        rows.map(|row: Summary| (row.status, row.reason)).collect()
    }
}

/// The text with one part replaced; the part must be there, once.
fn changed(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "`{from}` in the template");
    text.replace(from, to)
}

/// The configuration with another scene file.
fn config_of(scene: &str) -> String {
    let grid = "\"sphere_grid\"\nslices = 8";
    changed(CONFIG, grid, &format!("{scene:?}"))
}

/// Asserts that a run ends before it begins.
#[track_caller]
fn refused(room: &Room, config: &str, arguments: &[&str], parts: &[&str]) {
    let said = room.write("run.toml", config).run(arguments);
    said.fails(USAGE, parts);
    assert!(!room.has("out"), "a refused run left a run directory");
}

/// Asserts that a run of one cell records its failure.
#[track_caller]
fn recorded(room: &Room, scene: &str, parts: &[&str]) {
    let said = room.write("run.toml", config_of(scene)).run(&[]);
    said.fails(FAILED, &["1 of 1 cells failed", "report.html"]);
    let cells = room.cells();
    assert_eq!(cells[0].0, Status::Failed);
    for part in parts {
        assert!(cells[0].1.contains(part), "{}", cells[0].1);
    }
}

#[test]
fn the_templates_are_good() {
    let room = Room::new();
    room.write("model.obj", TRIANGLE).write("good.toml", SCENE);
    let config = format!("{CONFIG}\n[[scenes]]\nscene = \"good.toml\"\n");
    let said = room.write("run.toml", config).run(&[]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let ok = (Status::Ok, String::new());
    assert_eq!(room.cells(), [ok.clone(), ok]);
    for scene in ["good.toml", "model.obj"] {
        let said = room.render(scene, SMALL_MAP, &[]);
        assert_eq!(said.code, Some(0), "{scene}: {}", said.stderr);
    }
}

#[test]
fn a_configuration_is_refused_with_the_place_and_the_nearest_key() {
    let room = Room::new();
    #[rustfmt::skip]
    let table: &[(&str, &str, &[&str])] = &[
        ("seed = 1", "colour = 1", &["run.toml:6:1", "`colour`", "expected one of"]),
        ("frames = 1\nwarm", "farmes = 1\nwarm", &["run.toml:3:1", "did you mean `frames`?"]),
        ("slices", "slcies", &["run.toml:10:1", "did you mean `slices`?"]),
        ("resolution", "resolutoin", &["run.toml:14:1", "did you mean `resolution`?"]),
        ("seed = 1", "seed = \"x\"", &["run.toml:6:8", "string \"x\""]),
        ("resolution = 64", "resolution = 1.5", &["run.toml:14:14", "`shadow_map`", "1.5"]),
        ("resolution = 64", "resolution = 0", &["run.toml:14:14", "must be from 1 to"]),
        ("slices = 8", "slices = 7", &["run.toml:10:10", "even number", "not 7"]),
        ("slices = 8", "rows = 0", &["run.toml:9:9", "at least one row"]),
        ("slices = 8", "shells = 0", &["run.toml:9:9", "one shell"]),
        ("slices = 8", "size = [60000, 48]",
         &["run.toml: size of `sphere_grid_60000x48px`", "60000 × 48"]),
        ("slices = 8", "size = [64, 0]", &["run.toml:10:8", "64 × 0", "must be 1 to"]),
        ("frames = 1\nwarm", "frames = 0\nwarm", &["run.toml:3:10", "`frames` is 0", "from 1"]),
        ("[64, 48]", "[64, 0]", &["run.toml:2:8", "64 × 0", "must be 1 to"]),
        ("[64, 48]", "[64, 48, 3]", &["run.toml:2:8", "expected 2 numbers, found 3"]),
        ("[64, 48]", "[60000, 48]", &["run.toml: size", "at most", "60000 × 48"]),
        ("\"shadow_map\"", "\"shadow_mop\"", &["run.toml:13:6", "did you mean `shadow_map`?"]),
        ("id = \"shadow_map\"\n", "", &["run.toml:12:1", "no `id`"]),
        ("resolution = 64", "\n[[methods]]\nid = \"shadow_map\"\nresolution = 64\n\n\
          [[methods]]\nid = \"shadow_map\"\nresolution = 64", &["run.toml:19:1", "there already"]),
        ("\n[[methods]]", "\n[[scenes]]\nscene = \"sphere_grid\"\nslices = 8\n\n[[methods]]",
         &["run.toml:13:9", "`sphere_grid_n8` is there already"]),
        ("sphere_grid", "sphere_gird", &["run.toml:9:9", "did you mean `sphere_grid`?"]),
        ("sphere_grid", "none.toml", &["run.toml:9:9", "no scene file `none.toml`", "known:"]),
        ("title = ", "title ", &["run.toml:1:"]),
        ("slices = 8", "scales = [\"smole\"]", &["run.toml:10:11", "no `[scales.smole]`"]),
        ("seed = 1", "[scales.smoke]\nframse = 1", &["run.toml:7:1", "did you mean `frames`?"]),
        ("seed = 1", "[scales.full]\nframes = 2", &["run.toml:", "`[scales.full]`", "rename"]),
        ("\"shadow_map\"\nresolution = 64", "\"silhouette_ts\"\ncounting = \"z-fail\"",
         &["run.toml:14:12", "`z-fail`", "`z_fail`"]),
        ("\"shadow_map\"\nresolution = 64", "\"silhouette_ts\"\nmax_multiplicity = 33",
         &["run.toml:14:20", "from 1 to 32"]),
        ("\"shadow_map\"\nresolution = 64", "\"triangle_ts\"\npasses = 3",
         &["run.toml:14:10", "from 1 to 2"]),
        ("\"shadow_map\"\nresolution = 64", "\"triangle_ts\"\nfront_cap = \"in_plaec\"",
         &["run.toml:14:13", "did you mean `in_place`?"]),
        ("\"shadow_map\"\nresolution = 64", "\"triangle_gs\"\nnear = 0.0", &["run.toml:14:8", "`near` is 0"]),
        ("resolution = 64", "slope_bias = \"serach\"", &["run.toml:14:14", "serach", "\"search\""]),
        ("resolution = 64", "pcf = 4", &["run.toml:14:7", "`pcf` is 4", "odd"]),
        ("resolution = 64", "resolution = []", &["run.toml:14:14", "lists no value"]),
        ("resolution = 64", "resolution = [64, 1.5]", &["run.toml:14:19", "1.5"]),
        ("resolution = 64", "resolution = [64, 64]", &["run.toml:12:1", "there already"]),
        ("resolution = 64", "resolution = { from = 1, to = 9 }", &["run.toml:14:14", "a `factor` above 1"]),
        ("verified_frames = 1", "verify_every = 0", &["run.toml:5:16", "from 1"]),
        ("seed = 1", "verify_every = 2", &["run.toml:6:16", "remove one"]),
    ];
    for (from, to, parts) in table {
        refused(&room, &changed(CONFIG, from, to), &[], parts);
    }
    let parts = ["run.toml", "`[[methods]]`", "for example"];
    refused(&room, "", &[], &parts);
    let (no_methods, _) = CONFIG.split_once("\n[[methods]]").expect("methods");
    refused(&room, no_methods, &[], &parts);
}

#[test]
fn arguments_of_run_are_refused() {
    let room = Room::new();
    let table: &[(&[&str], &[&str])] = &[
        (&["--size", "0x48"], &["--size", "at least 1 pixel"]),
        (&["--size", "64"], &["--size", "like 1024x768"]),
        (&["--size", "60000x48"], &["--size", "at most"]),
        (&["--frames", "0"], &["--frames", "1.."]),
        (
            &["--scale", "half"],
            &["--scale", "no scale `half`", "has full"],
        ),
        (&["--only", "shadow_mop"], &["did you mean `shadow_map`?"]),
        (&["--only", "silhouette_ts"], &["run.toml does not run"]),
    ];
    for (arguments, parts) in table {
        refused(&room, CONFIG, arguments, parts);
    }
}

#[test]
fn a_file_that_is_no_configuration_is_refused() {
    let room = Room::new();
    room.write("bytes.toml", b"title = \"\xff\xfe\"");
    let table = [
        ("none.toml", "check the path"),
        (".", "name a TOML file"),
        ("bytes.toml", "UTF-8"),
    ];
    for (config, advice) in table {
        let said = room.svbench(["run", config, "--out", "out"]);
        said.fails(USAGE, &[&format!("{config}: cannot be read"), advice]);
        assert!(!room.has("out"), "{config}");
    }
}

#[test]
fn a_wrong_scene_file_is_refused_by_run_and_render() {
    let room = Room::new();
    room.write("model.obj", TRIANGLE);
    #[rustfmt::skip]
    let table: &[(&str, &str, &[&str])] = &[
        ("near", "naer", &[":17:1", "did you mean `near`?"]),
        ("\"obj\"", "\"objs\"", &[":4:8", "did you mean `obj`?"]),
        ("[3.0, 20.0, 5.0]", "[nan, 20.0, 5.0]", &[":13:12", "finite"]),
        ("[3.0, 20.0, 5.0]", "[3.0, 20.0, 5.0, 0.0]", &[":13:12", "expected 3 numbers, found 4"]),
        ("[0.6, 0.3, 3.0]", "[0.6, inf, 3.0]", &[":20:3", "finite"]),
        ("[0.6, 0.3, 3.0]", "[0.0, 0.0, 0.0]", &[":20:3", "move its eye or its target"]),
        ("time_s = 1.0", "time_s = 0.0", &[":20:3", "begin at 0 and increase"]),
        ("60.0", "180.0", &[":16:11", "below 180 degrees"]),
    ];
    let config = config_of("wrong.toml");
    for (from, to, parts) in table {
        let (place, words) = parts.split_first().expect("a place");
        let place = format!("wrong.toml{place}");
        let parts: Vec<_> = words.iter().copied().chain([&*place]).collect();
        room.write("wrong.toml", changed(SCENE, from, to));
        let in_config: Vec<_> = parts.iter().copied().chain(["run.toml:9:9"]).collect();
        refused(&room, &config, &[], &in_config);
        room.render("wrong.toml", SMALL_MAP, &[])
            .fails(USAGE, &parts);
    }
}

#[test]
fn a_mesh_other_than_expected_fails() {
    let room = Room::new();
    let other = changed(SCENE, "triangles = 1", "triangles = 2");
    room.write("model.obj", TRIANGLE).write("other.toml", other);
    let parts = ["scene other", "says 2 triangles", "correct [expect]"];
    room.render("other.toml", SMALL_MAP, &[])
        .fails(FAILED, &parts);
    recorded(&room, "other.toml", &parts);
}

#[test]
fn a_missing_model_skips_its_scene_and_the_run_goes_on() {
    let room = Room::new();
    room.write("lost.toml", SCENE);
    let config = config_of("lost.toml") + "\n[[scenes]]\nscene = \"sphere_grid\"\n";
    let said = room.write("run.toml", config).run(&[]);
    assert_eq!(said.code, Some(0), "{}", said.stderr);
    let cells = room.cells();
    assert_eq!((cells[0].0, cells[1].0), (Status::Skipped, Status::Ok));
    let places = ["model.obj not", "scenes/models/model", "SVBENCH_MODELS"];
    for part in places {
        assert!(cells[0].1.contains(part), "{}", cells[0].1);
        assert!(said.stdout.contains(part), "{}", said.stdout);
    }
    room.render("lost.toml", SMALL_MAP, &[])
        .fails(FAILED, &places);
}

#[test]
fn a_broken_model_fails_with_its_line() {
    let room = Room::new();
    fs::create_dir(room.path().join("folder.obj")).expect("a writable folder");
    #[rustfmt::skip]
    let table: &[(&str, &[u8], &[&str])] = &[
        ("empty.obj", b"", &["empty.obj: is empty", "export or download"]),
        ("points.obj", b"v 0 0 0\nv 1 0 0\n", &["points.obj: has no faces", "is it an OBJ file"]),
        ("cut.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", &["cut.obj:4:", "vertex 9, but 3"]),
        ("zero.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", &["zero.obj:4:", "vertex 0"]),
        ("short.obj", b"v 0 0 0\nv 1 0 0\n\nf 1 2\n", &["short.obj:4:", "at least three corners"]),
        ("nan.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", &["nan.obj:2:", "finite"]),
        ("inf.obj", b"v 0 0 0\nv 1 0 0\nv 0 -inf 0\nf 1 2 3\n", &["inf.obj:3:", "finite"]),
        ("ind.obj", b"v 0 0 0\nv 1 0 0\nv 0 0 1.#IND\nf 1 2 3\n", &["ind.obj:3:", "finite"]),
        ("zip.obj", b"\x1f\x8b\x08\0", &["zip.obj: is a gzip archive", "unpack it"]),
        ("mac.obj", b"v 0 0 0\rf 1 1 1\r", &["mac.obj:1:", "carriage return"]),
        ("word.obj", b"v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n", &["word.obj:2:", "`x` is not a num"]),
        ("bytes.obj", b"\xff\xfe\x00\x01\x80\n\x00\nv\xf0", &["bytes.obj: is UTF-16 text", "save it as UTF-8"]),
    ];
    for (file, contents, parts) in table {
        room.write(file, contents);
        room.render(file, SMALL_MAP, &[]).fails(FAILED, parts);
    }
    let said = room.render("folder.obj", SMALL_MAP, &[]);
    said.fails(FAILED, &["folder.obj: is a directory", "name the OBJ file"]);
    let said = room.render("none.obj", SMALL_MAP, &[]);
    said.fails(FAILED, &["none.obj: no such file", "check the path"]);

    // In a run, the line is in the results.
    let broken = "v 0 0 0\nv 1 0\n";
    room.write("model.obj", broken).write("broken.toml", SCENE);
    recorded(&room, "broken.toml", &["model.obj:2: a vertex needs three"]);
}

#[test]
fn a_map_larger_than_the_device_allows_fails_alone() {
    let room = Room::new();
    let both = "resolution = 65536\n\n[[methods]]\nid = \"shadow_map\"\nresolution = 64";
    let config = changed(CONFIG, "resolution = 64", both);
    let said = room.write("run.toml", config).run(&[]);
    said.fails(FAILED, &["1 of 2 cells failed", "report.html"]);
    let cells = room.cells();
    assert_eq!((cells[0].0, cells[1].0), (Status::Failed, Status::Ok));
    let too_large = "65536 × 65536 is larger than this device allows";
    assert!(cells[0].1.contains(too_large), "{}", cells[0].1);

    let said = room.render("sphere_grid", "shadow_map,resolution=65536", &[]);
    said.fails(FAILED, &["method `shadow_map`", too_large]);
}

#[test]
fn arguments_of_render_are_refused() {
    let room = Room::new();
    room.write("model.obj", TRIANGLE);
    #[rustfmt::skip]
    let table: &[(&[&str], &[&str])] = &[
        (&["--time", "99"], &["--time", "from 0 to 16 s, not to 99"]),
        (&["--time", "-0.5"], &["--time", "from 0 to 16 s, not to -0.5"]),
        (&["--time", "nan"], &["--time", "from 0 to 16 s"]),
        (&["--time", "1", "--eye", "0,0,9"], &["--time", "--eye", "cannot be used with"]),
        (&["--eye", "1,2,3", "--target", "1,2,3"], &["camera", "move its eye or its target"]),
        (&["--eye", "0,9,0", "--target", "0,0,0"], &["camera", "give another `up`"]),
        (&["--eye", "1,2"], &["--eye", "three numbers"]),
        (&["--fov", "180"], &["camera", "below 180 degrees"]),
        (&["--near", "-1"], &["camera", "near plane"]),
        (&["--light", "1,2"], &["--light", "X,Y,Z"]),
        (&["--light", "1,2,nan"], &["--light", "`nan` is not a finite number"]),
        (&["--light", "0,0,0,0"], &["--light", "length 0"]),
        (&["--light", "1,2,3,0.5"], &["--light", "1 (a point) or 0 (a direction)"]),
    ];
    for (arguments, parts) in table {
        room.render("sphere_grid", SMALL_MAP, arguments)
            .fails(USAGE, parts);
    }
    let said = room.render("sphere_gird", SMALL_MAP, &[]);
    said.fails(USAGE, &["`sphere_gird`", "did you mean `sphere_grid`?"]);
    for (method, advice) in [
        ("shadow_mop", "did you mean `shadow_map`?"),
        ("shadow_map,resolutoin=64", "did you mean `resolution`?"),
        ("shadow_map,resolution", "name=value"),
    ] {
        room.render("model.obj", method, &[])
            .fails(USAGE, &[advice]);
    }
    for (size, problem) in [("64x0", "at least 1 pixel"), ("60000x48", "at most")] {
        let said = room.svbench(["render", "model.obj", "--method", SMALL_MAP, "--size", size]);
        said.fails(USAGE, &["--size", problem]);
    }
}

#[test]
fn what_a_run_needs_besides_its_configuration() {
    let room = Room::new();
    room.write("run.toml", CONFIG);
    let said = room.run(&["--adapter", "no such adapter"]);
    said.fails(FAILED, &["`no such adapter`; there are: "]);
    assert!(!room.has("out"));
    let listed = room.svbench(["list", "devices", "--json"]).stdout;
    let devices: serde_json::Value = serde_json::from_str(&listed).expect("JSON");
    let name = devices["devices"][0]["name"].as_str().expect("a name");
    said.fails(FAILED, &[name]);

    fs::create_dir(room.path().join("out")).expect("a writable folder");
    room.write("out/mine.txt", "mine");
    room.run(&[]).fails(FAILED, &["out is not empty", "--out"]);
    let left = fs::read_dir(room.path().join("out")).expect("out");
    assert_eq!(left.count(), 1);

    for dir in ["out", "none"] {
        let said = room.svbench(["report", dir]);
        let message = format!("{dir} is not a run directory");
        said.fails(FAILED, &[&message, "run.json"]);
    }
    room.write("out/run.json", "{");
    let said = room.svbench(["report", "out"]);
    said.fails(FAILED, &["run.json is damaged", "line 1"]);
    assert!(!room.has("out/report.html") && !room.has("none"));
}
