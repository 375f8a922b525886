use super::super::mesh::LARGEST_COORDINATE;
use glam::Vec4;
use proptest::prelude::*;

use super::*;
use crate::scene::{CameraKey, Flight, Light, ModelSearch, Object, Part};

fn camera() -> CameraPath {
    CameraPath::framing(Vec3::NEG_ONE, Vec3::ONE)
}

fn scene(mesh: Mesh, light: Vec4, camera: CameraPath) -> Scene {
    let flight = Flight::under(Light::at(light), camera);
    Scene::new("x".to_owned(), "A \"title\"\n\\".to_owned(), mesh, flight)
}

fn there_and_back(scene: &Scene) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = write(scene, &folder.path().join("new"), "a.b c").unwrap();
    assert_eq!(path, folder.path().join("new/a.b c.toml"));
    let search = ModelSearch::for_scene_file(&path);
    SceneFile::read(&path).unwrap().load(&search).unwrap()
}

fn keys_of(light: &LightPath) -> &LightKeys {
    match light {
        LightPath::Keys(keys) => keys,
        LightPath::Sun(_) => panic!("it has keys"),
    }
}

/// Text for people does not say which zero it is, and equality does not either.
fn bits(scene: &Scene) -> Vec<u32> {
    let CameraPath {
        keys,
        up,
        fov_y_rad,
        near,
    } = &scene.flight.camera;
    let light = keys_of(&scene.flight.light);
    let keys = keys.iter().flat_map(|key| [key.eye, key.target]);
    let vectors = keys
        .chain([*up])
        .chain(light.keys.iter().map(|key| key.place));
    let vectors = vectors.chain(scene.mesh.positions.iter().copied());
    let numbers = vectors.flat_map(|v| v.to_array());
    let numbers = numbers.chain([light.w, *fov_y_rad, *near]);
    numbers.map(f32::to_bits).collect()
}

fn assert_same(read: &Scene, written: &Scene) {
    assert_eq!((read.name.as_str(), &read.title), ("a.b c", &written.title));
    assert_eq!(read.mesh.positions, written.mesh.positions);
    assert_eq!(read.mesh.triangles, written.mesh.triangles);
    assert_eq!(read.mesh_hash, written.mesh_hash);
    assert_eq!(read.flight, written.flight);
    assert_eq!(bits(read), bits(written));
}

fn triangle(y: f32) -> [Vec3; 3] {
    [
        Vec3::new(0.0, y, 0.0),
        Vec3::new(1.0, y, 0.0),
        Vec3::new(0.0, y, 1.0),
    ]
}

#[test]
fn receivers_stay_receivers_whatever_objects_are_called() {
    let odd = [
        "",
        "a",
        "a",
        " a",
        "unnamed_object",
        "o\nf 1 2 3",
        "ä #b",
        "a_",
        "x/y\\z\"",
        "]",
    ];
    let parts = odd.iter().enumerate().map(|(i, name)| {
        let part = Part::of_triangles(name, &[triangle(i as f32)]);
        if i % 2 == 0 { part.receiver() } else { part }
    });
    let written = scene(parts.collect(), Vec4::new(0.1, 9.0, 0.3, 1.0), camera());
    let read = there_and_back(&written);
    assert_same(&read, &written);
    let casts = |scene: &Scene| -> Vec<bool> {
        scene.mesh.objects.iter().map(|o| o.casts_shadow).collect()
    };
    assert_eq!(casts(&read), casts(&written));
    assert_same(&there_and_back(&read), &read);
}

#[test]
fn what_no_file_can_hold_is_refused_and_leaves_no_files() {
    let folder = tempfile::tempdir().unwrap();
    let light = Vec4::new(0.0, 9.0, 0.0, 1.0);
    let mesh = |p: [Vec3; 3]| Mesh::from_iter([Part::of_triangles("a", &[p])]);
    let good = mesh(triangle(0.0));
    let refusal = |scene: Scene| write(&scene, folder.path(), "x").unwrap_err();

    let nothing = refusal(scene(Mesh::default(), light, camera()));
    assert!(matches!(nothing, ExportError::NoTriangles));
    let nowhere = mesh([Vec3::ZERO, Vec3::X, Vec3::new(0.0, f32::NAN, 0.0)]);
    let nowhere = refusal(scene(nowhere, light, camera()));
    assert!(matches!(nowhere, ExportError::NotFinite(2)));
    for light in [
        Vec4::ZERO,
        Vec4::new(f32::NAN, 0.0, 0.0, 1.0),
        Vec4::new(1.0, 0.0, 0.0, 0.5),
    ] {
        let error = refusal(scene(good.clone(), light, camera()));
        assert!(matches!(error, ExportError::Invalid(_)), "{error:?}");
    }
    let blind = CameraPath {
        near: f32::INFINITY,
        ..camera()
    };
    assert!(matches!(
        refusal(scene(good, light, blind)),
        ExportError::Invalid(_)
    ));
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

#[test]
fn a_mesh_that_was_built_otherwise_keeps_its_triangles() {
    // Vertices in another order than that of their use, one twice and one unused.
    let mesh = Mesh {
        positions: vec![Vec3::ONE, Vec3::Z, Vec3::X, Vec3::ZERO, Vec3::X],
        triangles: vec![[2, 3, 1], [1, 3, 4]],
        objects: vec![Object {
            name: "a".to_owned(),
            vertices: 0..5,
            triangles: 0..2,
            casts_shadow: true,
        }],
    };
    let written = scene(mesh, Vec4::Y, camera());
    let read = there_and_back(&written);
    assert_eq!(read.mesh.positions.len(), 3);
    for triangle in 0..2 {
        assert_eq!(read.mesh.corners(triangle), written.mesh.corners(triangle));
    }
}

#[test]
fn degrees_are_short_and_exact() {
    for whole in [30.0, 45.0, 50.0, 60.0, 90.0] {
        assert_eq!(degrees(radians(whole)), format!("{whole:?}"));
    }
    assert_eq!(number(0.1), "0.1");
    assert_eq!(number(-0.0), "-0.0");
}

fn coordinate() -> impl Strategy<Value = f32> {
    let any = any::<f32>().prop_filter("not too large", |x| x.abs() <= LARGEST_COORDINATE);
    let few = prop::sample::select(vec![
        0.0,
        -0.0,
        1.0,
        1e-12,
        -1e-12,
        9e-13,
        1e-40,
        LARGEST_COORDINATE,
        -1e9,
    ]);
    prop_oneof![-3.0f32..3.0, any, few]
}

fn point() -> impl Strategy<Value = Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(Vec3::from_array)
}

prop_compose! {
    fn soup()(
        points in prop::collection::vec(point(), 1..20),
        corners in prop::collection::vec(any::<[u8; 3]>(), 1..30),
        casts in any::<bool>(),
        name in "[a-c #\n]{0,2}",
    ) -> Part {
        let count = points.len() as u32;
        let triangles = corners.iter().map(|t| t.map(|v| u32::from(v) % count)).collect();
        let part = Part::new(&name, &points, triangles);
        if casts { part } else { part.receiver() }
    }
}

proptest! {
    #[test]
    fn scenes_come_back_to_the_bit(
        parts in prop::collection::vec(soup(), 1..5),
        lights in prop::collection::vec((point(), 0.001f64..9.0), 1..4),
        is_point in any::<bool>(),
        eyes in prop::collection::vec((point(), -3.0f32..3.0, 0.001f64..9.0), 1..4),
        fov_y_rad in 0.01f32..3.1,
        near in 1e-6f32..1e3,
    ) {
        let mut time_s = -eyes[0].2;
        let keys = eyes.iter().map(|&(eye, x, after_s)| {
            time_s += after_s;
            CameraKey { time_s, eye, target: Vec3::new(x, -0.0, 0.1) }
        });
        let camera = CameraPath { keys: keys.collect(), up: Vec3::new(-0.0, 1.0, 0.3), fov_y_rad, near };
        prop_assume!(camera.validate().is_ok());
        let mut time_s = -lights[0].1;
        let keys = lights.iter().map(|&(place, after_s)| {
            time_s += after_s;
            LightKey { time_s, place }
        });
        let light = LightKeys { keys: keys.collect(), w: f32::from(u8::from(is_point)), radius: 0.0 };
        let light = LightPath::Keys(light);
        let mesh = parts.into_iter().collect();
        let written = Scene::new("x".to_owned(), "x".to_owned(), mesh, Flight { camera, light });
        prop_assume!(written.flight.light.validate().is_ok());
        assert_same(&there_and_back(&written), &written);
    }

    #[test]
    fn every_opening_angle_has_its_degrees(bits in 0x3500_0000u32..0x4049_0fdb) {
        let angle = f32::from_bits(bits);
        prop_assert_eq!(radians(degrees(angle).parse().unwrap()), angle);
    }

    #[test]
    fn every_number_has_its_text(bits in any::<u32>()) {
        let x = f32::from_bits(bits);
        let read = number(x).parse::<f64>().unwrap() as f32;
        prop_assert!(read.to_bits() == bits || x.is_nan());
    }
}
