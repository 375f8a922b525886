//! The program as its users run it.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::process::{Command, Output};

const CONFIG: &str = r#"
title = "Test"
size = [64, 48]
frames = 3
warmup_frames = 1
verified_frames = 2
seed = 7
[[scenes]]
scene = "sphere_grid"
slices = 8
[[methods]]
id = "silhouette_ts"
[[methods]]
id = "silhouette_gs"
[[methods]]
id = "shadow_map"
resolution = 256
"#;

fn svbench(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_svbench"));
    command.args(args).env("SVBENCH_CACHE", "");
    command
}

fn succeed(args: &[&str]) -> Output {
    let output = svbench(args).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{args:?}: {errors}");
    output
}

fn json(args: &[&str]) -> serde_json::Value {
    serde_json::from_slice(&succeed(args).stdout).unwrap()
}

fn rows(path: &Path) -> Vec<std::collections::HashMap<String, String>> {
    csv::Reader::from_path(path)
        .unwrap()
        .deserialize()
        .map(Result::unwrap)
        .collect()
}

/// A configuration and the run directory that does not exist yet.
fn workplace(config: &str) -> (tempfile::TempDir, String, String) {
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).to_string_lossy().into_owned();
    std::fs::write(path("config.toml"), config).unwrap();
    let (config, out) = (path("config.toml"), path("run"));
    (dir, config, out)
}

#[test]
fn scenes_may_have_shells_and_pictures_of_their_own_size() {
    let scene = "[[scenes]]\nscene = \"sphere_grid\"\nslices = 8\n";
    let larger = format!("{scene}size = [96, 40]\n{scene}size = [48, 20]\n{scene}shells = 3\n");
    assert!(CONFIG.contains(scene));
    let (_dir, config, out) = workplace(&CONFIG.replace(scene, &format!("{scene}{larger}")));
    succeed(&["run", &config, "--out", &out]);
    let out = Path::new(&out);
    let summary = rows(&out.join("summary.csv"));
    let of = |row: &std::collections::HashMap<String, String>| {
        ["scene", "width", "height", "triangles"].map(|column| row[column].clone())
    };
    for (rows, expected) in summary.chunks(3).zip([
        ["sphere_grid_n8", "64", "48", "6400"],
        ["sphere_grid_n8_96x40px", "96", "40", "6400"],
        ["sphere_grid_n8_48x20px", "48", "20", "6400"],
        ["sphere_grid_d3_n8", "64", "48", "19200"],
    ]) {
        for row in rows {
            assert_eq!(
                (of(row), &*row["status"]),
                (expected.map(str::to_owned), "ok")
            );
        }
    }
    let picture = out.join("images/sphere_grid_n8_96x40px__reference.png");
    let reader = png::Decoder::new(std::io::BufReader::new(
        std::fs::File::open(picture).unwrap(),
    ));
    assert_eq!(reader.read_info().unwrap().info().size(), (96, 40));
    assert!(out.join("plots/shadow_time_by_pixels.svg").is_file());
    // One of a kind alone.
    assert!(!out.join("plots/shadow_time_by_shells.svg").is_file());
}

#[test]
fn a_run_leaves_everything_that_the_contract_names() {
    let (_dir, config, out) = workplace(CONFIG);
    succeed(&["run", &config, "--out", &out, "--validation"]);
    let out = Path::new(&out);
    let header = std::fs::read_to_string(out.join("summary.csv")).unwrap();
    assert!(header.starts_with(
        "scene,triangles,objects,method,variant,width,height,frames,fps,frame_ms_median,\
         shadow_ms_median,shadow_ms_p95,gbuffer_ms_median,false_lit,false_shadowed,artifact_px,\
         ambiguous_px,status,reason"
    ));
    let summary = rows(&out.join("summary.csv"));
    assert_eq!(summary.len(), 3);
    let samples = rows(&out.join("samples.csv"));
    assert_eq!(samples.len(), 9);
    for row in &summary {
        assert_eq!(
            (&*row["scene"], &*row["triangles"], &*row["objects"]),
            ("sphere_grid_n8", "6400", "100")
        );
        assert_eq!((&*row["status"], &*row["frames"]), ("ok", "3"), "{row:?}");
        // The figures of a cell are those of its samples.
        let own = samples.iter().filter(|s| s["method"] == row["method"]);
        let mut frame_ms: Vec<f64> = own.map(|s| s["frame_ms"].parse().unwrap()).collect();
        frame_ms.sort_by(f64::total_cmp);
        let fps = 3000.0 / frame_ms.iter().sum::<f64>();
        let close =
            |name: &str, value: f64| (row[name].parse::<f64>().unwrap() / value - 1.0).abs() < 1e-9;
        assert!(
            close("frame_ms_median", frame_ms[1]) && close("fps", fps),
            "{row:?}"
        );
        let shadow: f64 = row["shadow_ms_median"].parse().unwrap();
        assert!(shadow > 0.0 && shadow < frame_ms[2], "{row:?}");
    }
    // What the stages of a frame took together is its shadow time.
    let stages = rows(&out.join("stages.csv"));
    for sample in &samples {
        let same = |stage: &&std::collections::HashMap<String, String>| {
            ["method", "variant", "frame"]
                .iter()
                .all(|key| stage[*key] == sample[*key])
        };
        let own = stages.iter().filter(same);
        let sum =
            |column: &str| -> f64 { own.clone().map(|s| s[column].parse::<f64>().unwrap()).sum() };
        for (of_stages, of_sample) in [
            ("device_ms", "shadow_device_ms"),
            ("cpu_ms", "shadow_cpu_ms"),
        ] {
            let shadow: f64 = sample[of_sample].parse().unwrap();
            assert!(
                (sum(of_stages) - shadow).abs() < 1e-6,
                "{of_stages} of {sample:?}"
            );
        }
    }
    // At each camera position every method once, in an order that changes.
    let order: Vec<(&str, &str)> = samples
        .iter()
        .map(|s| (&*s["frame"], &*s["method"]))
        .collect();
    for (round, methods) in order.chunks(3).enumerate() {
        assert!(
            methods.iter().all(|(frame, _)| *frame == round.to_string()),
            "{order:?}"
        );
        let mut names: Vec<_> = methods.iter().map(|(_, method)| method).collect();
        names.sort();
        assert_eq!(names, [&"shadow_map", &"silhouette_gs", &"silhouette_ts"]);
    }
    let info: serde_json::Value =
        serde_json::from_slice(&std::fs::read(out.join("run.json")).unwrap()).unwrap();
    assert_eq!(info["status"], "complete");
    assert_eq!(info["config_text"], CONFIG);
    assert_eq!(info["scenes"][0]["edges"]["manifold"], 9600);
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(
        !page.contains("src=\"http") && !page.contains("href=\"http"),
        "self-contained"
    );
    assert_eq!(
        page.matches("data:image/png").count(),
        1 + 3 * 3,
        "a gallery of every method"
    );
    assert!(out.join("plots").read_dir().unwrap().count() >= 2);
}

const ACCURACY: &str = r#"
title = "Accuracy"
size = [160, 120]
frames = 4
warmup_frames = 0
verified_frames = 0

[[scenes]]
scene = "sphere_grid"
slices = 8

[[methods]]
id = "silhouette_gs"
depth = ["reversed", "standard"]

[[methods]]
id = "shadow_map"
resolution = { from = 64, to = 256, factor = 2 }
pcf = [1, 3]

[[methods]]
id = "cube_shadow_map"
resolution = 512
constant_bias = 0
slope_bias = "search"
"#;

#[test]
fn accuracy_verifies_along_the_flight_and_charts_what_it_finds() {
    let (_dir, config, out) = workplace(ACCURACY);
    succeed(&[
        "accuracy",
        &config,
        "--out",
        &out,
        "--every",
        "2",
        "--validation",
    ]);
    let out = Path::new(&out);
    let (summary, metrics) = (
        rows(&out.join("summary.csv")),
        rows(&out.join("metrics.csv")),
    );
    let frames = || metrics.iter().filter(|row| row["metric"] == "false_lit");
    assert_eq!((summary.len(), frames().count()), (9, 18));
    for row in &summary {
        let of = |metric: &&std::collections::HashMap<String, String>| {
            metric["method"] == row["method"] && metric["variant"] == row["variant"]
        };
        let own: Vec<_> = metrics.iter().filter(of).collect();
        for column in [
            "false_lit",
            "false_shadowed",
            "boundary_px",
            "followed_px",
            "flicker_px",
        ] {
            let values = own.iter().filter(|metric| metric["metric"] == column);
            let values: Vec<u64> = values
                .map(|metric| metric["value"].parse().unwrap())
                .collect();
            assert_eq!(values.len(), 2, "{column} of {row:?}");
            let sum: u64 = values.iter().sum();
            assert_eq!(row[column], sum.to_string(), "{column} of {row:?}");
        }
        assert!(row["followed_px"].parse::<u64>().unwrap() > 1000, "{row:?}");
        let flip: f64 = row["flip_mean"].parse().unwrap();
        let wrong = row["false_lit"] != "0" || row["false_shadowed"] != "0";
        // A filtered map's grey edges are seen, though they count as right.
        let is_grey = row["variant"].contains("pcf");
        assert!((flip > 0.0) == wrong || is_grey, "{row:?}");
    }
    // Measured frames 0 and 2 of 4.
    let times: Vec<_> = frames().map(|row| &*row["time_s"]).collect();
    assert_eq!((times[0], times[9]), ("0.0", times[17]));
    assert!(times[9].parse::<f64>().unwrap() > 1.0);

    let info: serde_json::Value =
        serde_json::from_slice(&std::fs::read(out.join("run.json")).unwrap()).unwrap();
    let methods = info["methods"].as_array().unwrap();
    let on_curve = |curve: &str| {
        let points = methods.iter().filter(|m| m["sweep"]["curve"] == curve);
        points
            .map(|m| m["sweep"]["value"].as_f64().unwrap())
            .collect::<Vec<_>>()
    };
    assert_eq!(on_curve("pcf=3"), [64.0, 128.0, 256.0]);
    assert_eq!(on_curve(""), [64.0, 128.0, 256.0]);

    // The bias that was found takes acne away.
    let bias = &rows(&out.join("bias.csv"))[0];
    let px = |column: &str| bias[column].parse::<f64>().unwrap();
    assert_eq!(bias["resolution"], "512");
    assert!(
        px("acne_px_unbiased") > 10.0 && px("acne_px") < 1.0,
        "{bias:?}"
    );
    let found: f64 = bias["slope_bias"].parse().unwrap();
    assert!(found > 0.1 && found < 8.0, "{bias:?}");

    // The chart's numbers are the summary's.
    let pareto = rows(&out.join("pareto.csv"));
    assert_eq!(pareto.len(), 9);
    for row in &pareto {
        let of = |s: &&std::collections::HashMap<String, String>| {
            s["method"] == row["method"] && s["variant"] == row["variant"]
        };
        let own = summary.iter().find(of).unwrap();
        for column in [
            "shadow_ms_median",
            "false_lit",
            "false_shadowed",
            "artifact_px",
        ] {
            assert_eq!(row[column], own[column]);
        }
    }
    assert!(pareto.iter().any(|row| row["front"] == "true"));
    assert!(out.join("plots/pareto_sphere_grid_n8.svg").is_file());
}

#[test]
fn only_size_and_frames_override_the_configuration() {
    let (_dir, config, out) = workplace(CONFIG);
    let only = ["--only", "shadow_map", "--size", "32x16", "--frames", "2"];
    succeed(&[&["run", &config, "--out", &out], &only[..]].concat());
    let summary = rows(&Path::new(&out).join("summary.csv"));
    let row = &summary[0];
    assert_eq!(summary.len(), 1);
    assert_eq!(
        (
            &*row["variant"],
            &*row["width"],
            &*row["height"],
            &*row["frames"]
        ),
        ("resolution=256", "32", "16", "2")
    );
}

#[test]
fn a_scale_replaces_numbers_and_leaves_scenes_out() {
    let config = r#"
title = "Scales"
size = [64, 48]
frames = 9
warmup_frames = 0
verified_frames = 0

[scales.tiny]
size = [16, 12]
frames = 2

[[scenes]]
scene = "sphere_grid"
slices = 8

[[scenes]]
scene = "sphere_grid"
slices = 12
scales = ["full"]

[[methods]]
id = "silhouette_gs"
counting = "auto"
max_multiplicity = 1
"#;
    let (_room, config, out) = workplace(config);
    succeed(&["run", &config, "--scale", "tiny", "--out", &out]);
    let info = std::fs::read_to_string(Path::new(&out).join("run.json")).unwrap();
    let info: serde_json::Value = serde_json::from_str(&info).unwrap();
    assert_eq!(
        (&info["scale"], &info["width"]),
        (&"tiny".into(), &16.into())
    );
    let cells = rows(&Path::new(&out).join("summary.csv"));
    assert_eq!(cells.len(), 1, "{cells:?}");
    assert_eq!(cells[0]["frames"], "2");
    // 96 edges a sphere of 64 triangles, each split in two.
    let counters = rows(&Path::new(&out).join("counters.csv"));
    for (name, count) in [("edges", "9600"), ("edge_records", "19200")] {
        let row = counters.iter().find(|row| row["counter"] == name);
        assert_eq!(row.map(|row| &*row["value"]), Some(count), "{counters:?}");
    }
    let record_ms: f64 = cells[0]["record_ms_median"].parse().unwrap();
    let cpu_ms: f64 = cells[0]["cpu_ms_median"].parse().unwrap();
    assert!(record_ms > 0.0 && record_ms <= cpu_ms, "{cells:?}");
    // G-buffer with its pass over the picture, at least the sides, resolve, shading.
    let draw_calls: u32 = cells[0]["draw_calls"].parse().unwrap();
    assert!(draw_calls >= 101 + 1 + 100 + 2, "{draw_calls}");
}

#[test]
fn the_report_can_be_made_again() {
    let (_dir, config, out) = workplace(CONFIG);
    succeed(&["run", &config, "--out", &out]);
    let page = Path::new(&out).join("report.html");
    let before = std::fs::read_to_string(&page).unwrap();
    std::fs::remove_file(&page).unwrap();
    succeed(&["report", &out]);
    assert_eq!(std::fs::read_to_string(&page).unwrap(), before);
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_keeps_what_it_has() {
    let (_dir, config, out) = workplace(&CONFIG.replace("frames = 3", "frames = 100000"));
    let mut child = svbench(&["run", &config, "--out", &out])
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let samples = Path::new(&out).join("samples.csv");
    let some = || std::fs::read_to_string(&samples).is_ok_and(|text| text.lines().count() > 4);
    while !some() {
        assert!(child.try_wait().unwrap().is_none(), "ended too early");
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(1));
    let out = Path::new(&out);
    let info: serde_json::Value =
        serde_json::from_slice(&std::fs::read(out.join("run.json")).unwrap()).unwrap();
    assert_eq!(info["status"], "interrupted");
    let measured: usize = rows(&out.join("summary.csv"))
        .iter()
        .map(|row| row["frames"].parse::<usize>().unwrap())
        .sum();
    assert_eq!(measured, rows(&samples).len());
    assert!(measured >= 4 && out.join("report.html").is_file());
}

#[test]
fn render_writes_pictures_and_counts() {
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).to_string_lossy().into_owned();
    let (picture, mask, reference, error) =
        (path("p.png"), path("m.png"), path("r.png"), path("e.png"));
    let counts = json(&[
        "render",
        "sphere_grid",
        "--method",
        "silhouette_gs",
        "--size",
        "80x60",
        "--time",
        "3.5",
        "--out",
        &picture,
        "--mask",
        &mask,
        "--reference",
        &reference,
        "--error",
        &error,
        "--json",
    ]);
    let read = |path: &str| {
        let decoder =
            png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!((info.width, info.height), (80, 60));
        (info.color_type, bytes)
    };
    let (kind, mask) = read(&mask);
    assert_eq!(kind, png::ColorType::Grayscale);
    assert!(mask.iter().all(|m| [0, 255].contains(m)) && mask.contains(&255));
    let (_, reference) = read(&reference);
    let differ = mask
        .iter()
        .zip(&reference)
        .filter(|(m, r)| **r != 128 && m != r)
        .count() as u64;
    let errors = &counts["errors"];
    let wrong = errors["false_lit"].as_u64().unwrap() + errors["false_shadowed"].as_u64().unwrap();
    assert_eq!(differ, wrong);
    assert_eq!(errors["artifact_px"], 0);
    assert!(counts["stages_ms"]["volumes"].as_f64().unwrap() > 0.0);
    assert_eq!(read(&error).0, png::ColorType::Rgb);
    assert_eq!(read(&picture).0, png::ColorType::Rgba);
}

#[test]
fn render_takes_a_bare_model_a_camera_and_a_light() {
    let dir = tempfile::tempdir().unwrap();
    let model = dir.path().join("two.obj");
    // A small triangle over a large one.
    std::fs::write(
        &model,
        "v -9 0 -9\nv 0 0 9\nv 9 0 -9\nv -1 2 -1\nv 0 2 1\nv 1 2 -1\nf 1 2 3\nf 4 5 6\n",
    )
    .unwrap();
    let camera = [
        "--eye", "-1,6,7", "--target", "0,0,0", "--up", "0,1,0", "--fov", "45", "--near", "0.5",
    ];
    for light in ["0,9,0", "0,1,0,0"] {
        let args = [
            "render",
            model.to_str().unwrap(),
            "--method",
            "silhouette_ts",
            "--light",
            light,
            "--size",
            "64x64",
            "--json",
        ];
        let counts = json(&[&args, &camera[..]].concat());
        assert_eq!(counts["triangles"], 2);
        assert_eq!(counts["errors"]["artifact_px"], 0, "light {light}");
    }
}

#[test]
fn lists_say_what_can_run_here() {
    let all = json(&["list", "--json"]);
    let ids: Vec<_> = all["methods"]
        .as_array()
        .unwrap()
        .iter()
        .map(|m| m["id"].as_str().unwrap())
        .collect();
    assert_eq!(
        ids,
        [
            "silhouette_ts",
            "silhouette_gs",
            "silhouette_cpu",
            "silhouette_cs",
            "silhouette_ms",
            "silhouette_vs",
            "triangle_ts",
            "triangle_gs",
            "adjacency_gs",
            "ray_query",
            "ray_compute",
            "ray_cpu",
            "alias_free_map",
            "triangle_frusta",
            "shadow_map",
            "cube_shadow_map"
        ]
    );
    for method in all["methods"].as_array().unwrap() {
        assert_eq!(method["available"], true, "{method}");
        assert!(!method["limits"].as_array().unwrap().is_empty());
        for limit in method["limits"].as_array().unwrap() {
            let at_most = &limit["at_most"];
            let share = at_most["share"]
                .as_f64()
                .map(|share| share > 0.0 && share < 1.0);
            let px = at_most["px"].as_u64().map(|px| (1..100).contains(&px));
            let is_bound = share.or(px).unwrap_or(at_most == "all");
            assert!(is_bound, "{limit}");
        }
    }
    assert!(
        all["scenes"]
            .as_array()
            .unwrap()
            .iter()
            .any(|s| s["name"] == "sponza" && s["triangles"] == 262_267)
    );
    assert!(!all["devices"].as_array().unwrap().is_empty());
    let text = String::from_utf8(succeed(&["list", "methods"]).stdout).unwrap();
    for word in [
        "silhouette_ts",
        "needs: tessellation shaders",
        "limit:",
        "parameter: resolution = 8192",
        "available",
    ] {
        assert!(text.contains(word), "{word}");
    }
}

#[test]
fn a_stress_run_tells_declared_failures_from_others() {
    let dir = tempfile::tempdir().unwrap();
    let path = |name: &str| dir.path().join(name).to_string_lossy().into_owned();
    let stress = |methods: &[&str], out: &str| {
        let mut args = vec![
            "stress",
            "--cause",
            "eye_in_volume",
            "--size",
            "80x60",
            "--out",
            out,
        ];
        methods
            .iter()
            .for_each(|method| args.extend(["--method", method]));
        svbench(&args).output().unwrap()
    };
    // Z-pass fails in a volume, and says so.
    let out = path("declared");
    let output = stress(&["silhouette_gs", "silhouette_gs,counting=z_pass"], &out);
    assert_eq!(output.status.code(), Some(0));
    let matrix = String::from_utf8(output.stdout).unwrap();
    assert!(matrix.contains("eye_in_volume  ·  0.48"), "{matrix}");
    let out = Path::new(&out);
    let rows = rows(&out.join("stability.csv"));
    assert_eq!(rows.len(), 18);
    let failed: Vec<_> = rows
        .iter()
        .filter(|row| row["outcome"] == "declared")
        .collect();
    assert_eq!(failed.len(), 6);
    assert!(failed.iter().all(|row| row["variant"] == "counting=z_pass"));
    let pictures: Vec<_> = failed
        .iter()
        .filter(|row| !row["picture"].is_empty())
        .collect();
    assert_eq!(pictures.len(), 1, "the first failure has a picture");
    assert!(out.join("failures").join(&pictures[0]["picture"]).is_file());
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(
        page.contains("data:image/png"),
        "the page holds the picture"
    );

    // The scene that failed fails again.
    let scene = out.join("failures/eye_in_volume_0.48.toml");
    let scene = scene.to_string_lossy().into_owned();
    let method = "silhouette_gs,counting=z_pass";
    let again = json(&[
        "render", &scene, "--method", method, "--size", "80x60", "--json",
    ]);
    let artifacts = again["errors"]["artifact_px"].as_u64().unwrap();
    assert_eq!(artifacts.to_string(), pictures[0]["artifact_px"]);

    // Nothing declares what pulling volumes towards the eye does.
    let output = stress(&["silhouette_gs,push_back_px=-1"], &path("undeclared"));
    assert_eq!(output.status.code(), Some(1));
    let errors = String::from_utf8(output.stderr).unwrap();
    assert!(
        errors.contains("no limit of the method declares"),
        "{errors}"
    );
}

#[test]
fn fuzzing_tells_the_seeds_that_fail() {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().to_string_lossy().into_owned();
    let method = "silhouette_gs,counting=z_pass";
    let args = ["fuzz", "--cases", "3", "--method", method, "--out", &out];
    let output = svbench(&args).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.contains("seed 1: silhouette_gs,counting=z_pass"),
        "{text}"
    );
    assert!(dir.path().join("random_1.toml").is_file());
    // The same scene, by its seed and from its file.
    let one = ["fuzz", "--cases", "1", "--seed", "1"];
    succeed(
        &[
            &one[..],
            &["--method", "silhouette_gs", "--method", "triangle_ts"],
        ]
        .concat(),
    );
    let scene = dir
        .path()
        .join("random_1.toml")
        .to_string_lossy()
        .into_owned();
    let again = json(&[
        "render", &scene, "--method", method, "--size", "160x120", "--json",
    ]);
    let artifacts = again["errors"]["artifact_px"].as_u64().unwrap();
    assert!(
        text.contains(&format!("{artifacts} artifact pixels")),
        "{artifacts}: {text}"
    );
    let none = succeed(&["fuzz", "--seconds", "0", "--method", "silhouette_gs"]);
    assert!(
        String::from_utf8(none.stdout).unwrap().contains(" 0  "),
        "no time, no case"
    );
}
