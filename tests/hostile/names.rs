//! Names that file systems do not like, or that no text can hold.

use crate::room::{CONFIG, MODEL, Room, SCENE, ends};
use std::collections::BTreeSet;
use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::OsStrExt;

/// A name that is no UTF-8.
fn raw(name: &str) -> OsString {
    let mut bytes = b"\xff\xfe ".to_vec();
    bytes.extend(name.as_bytes());
    OsStr::from_bytes(&bytes).to_owned()
}

#[test]
fn every_scene_has_pictures_of_its_own() {
    let room = Room::new();
    let long = "x".repeat(240);
    let names = [
        "a b",
        "a-b",
        "a_b",
        "A-b",
        "a  b",
        "é",
        "con",
        "all",
        &long,
        &long[1..],
    ];
    let mut config =
        "title = \"Names\"\nsize = [32, 24]\nframes = 1\nwarmup_frames = 0\nverified_frames = 1\n\
                      [[methods]]\nid = \"shadow_map\"\nresolution = 64\n"
            .to_owned();
    for (i, name) in names.iter().enumerate() {
        config.push_str(&format!("[[scenes]]\nscene = \"{name}.toml\"\n"));
        let scene = SCENE.replace("model.obj", &format!("model{i}.obj"));
        // Each sheet at another height, so that no two pictures are alike.
        let height = format!(" {}.5 ", i % 3);
        room.write(
            format!("{name}.toml"),
            scene.replace("0.25]", &format!("{}]", 0.25 + 0.1 * i as f32)),
        );
        room.write(
            format!("model{i}.obj"),
            MODEL.replace(" 1 -1\n", &format!("{height}-1\n")),
        );
    }
    room.write("config.toml", config);
    ends(&mut room.svbench(["run", "config.toml", "--out", "run"]), 0);
    let files: BTreeSet<String> = room
        .path("run/images")
        .read_dir()
        .unwrap()
        .map(|file| file.unwrap().file_name().to_string_lossy().to_lowercase())
        .collect();
    // Truth, picture, mask and errors.
    assert_eq!(files.len(), 4 * names.len(), "{files:?}");
    assert!(
        files.contains("a-b__shadow_map__resolution-64_mask.png"),
        "{files:?}"
    );
    let page = room.read("run/report.html");
    let pictures: BTreeSet<&str> = page
        .split("src=\"data:image/png;base64,")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap())
        .collect();
    assert!(pictures.len() > 2 * names.len(), "{}", pictures.len());
}

#[test]
fn two_scenes_of_one_name_are_refused() {
    let room = Room::furnished();
    for folder in ["a", "b"] {
        std::fs::create_dir(room.path(folder)).unwrap();
        room.write(format!("{folder}/x.toml"), SCENE);
    }
    let scenes = "[[scenes]]\nscene = \"a/x.toml\"\n[[scenes]]\nscene = \"b/x.toml\"\n";
    room.write(
        "config.toml",
        CONFIG.replace("[[scenes]]", &format!("{scenes}[[scenes]]")),
    );
    let (_, errors) = ends(&mut room.svbench(["run", "config.toml", "--out", "run"]), 2);
    assert!(errors.contains("rename one of the two"), "{errors}");
    assert!(!room.path("run").exists());
}

#[test]
fn arguments_need_not_be_text() {
    let room = Room::furnished();
    let names = [
        raw("config.toml"),
        raw("scene.toml"),
        raw("model.obj"),
        raw("stress.toml"),
    ];
    let [config, scene, model, stress] = &names;
    room.write(config, CONFIG);
    room.write(scene, SCENE);
    room.write(model, MODEL);
    room.write(stress, "title = \"t\"\nsize = [32, 24]\ncauses = [\"contact\"]\n[[methods]]\nid = \"shadow_map\"\n");
    let word = OsStr::new;
    let out = raw("out.png");
    for scene in [scene, model] {
        let (text, _) = ends(
            &mut room.svbench([
                word("render"),
                scene,
                word("--method"),
                word("shadow_map"),
                word("--size"),
                word("32x24"),
                word("--out"),
                &out,
                word("--json"),
            ]),
            0,
        );
        serde_json::from_str::<serde_json::Value>(&text).unwrap();
        assert!(room.path(&out).is_file());
    }
    for (command, config) in [("run", config), ("accuracy", config), ("stress", stress)] {
        let dir = raw(command);
        ends(
            &mut room.svbench([word(command), config, word("--out"), &dir]),
            0,
        );
        ends(&mut room.svbench([word("report"), &dir]), 0);
    }
    let command = &room.json(std::path::Path::new(&raw("run")).join("run.json"))["command"];
    assert!(
        command[2].as_str().unwrap().contains("config.toml"),
        "{command}"
    );
    let merged = raw("merged");
    ends(
        &mut room.svbench([word("report"), &raw("run"), word("--out"), &merged]),
        0,
    );
    ends(
        &mut room.svbench([
            word("metamorphic"),
            scene,
            word("--method"),
            word("shadow_map"),
            word("--soups"),
            word("0"),
            word("--size"),
            word("32x24"),
        ]),
        0,
    );
    // Without --out, the directory is named after the configuration.
    ends(&mut room.svbench([word("run"), config]), 0);
}

#[test]
fn folders_in_the_environment_need_not_be_text() {
    let room = Room::furnished();
    let (models, cache) = (raw("models"), raw("cache"));
    std::fs::create_dir(room.path(&models)).unwrap();
    std::fs::rename(room.path("model.obj"), room.path(&models).join("model.obj")).unwrap();
    let mut render = room.svbench([
        "render",
        "scene.toml",
        "--method",
        "shadow_map",
        "--size",
        "32x24",
    ]);
    render.env("SVBENCH_MODELS", room.path(&models));
    render.env("SVBENCH_CACHE", room.path(&cache));
    render.env("TMPDIR", room.path(&models));
    ends(&mut render, 0);
    assert!(room.path(&cache).read_dir().unwrap().next().is_some());
}

#[test]
fn words_that_are_no_text_are_refused() {
    let room = Room::furnished();
    let word = OsStr::new;
    let method = raw("shadow_map");
    let (_, errors) = ends(
        &mut room.svbench([
            word("render"),
            word("scene.toml"),
            word("--method"),
            &method,
        ]),
        2,
    );
    assert!(errors.contains("UTF-8"), "{errors}");
    ends(&mut room.svbench([raw("run")]), 2);
    ends(&mut room.svbench([word("run"), &raw("not there.toml")]), 2);
}
