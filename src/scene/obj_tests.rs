use std::io::Write;

use glam::Vec3;
use proptest::prelude::*;

use super::*;

const CUBE_CORNER: &str = "\
# a comment
mtllib missing.mtl
v 0 0 0
v 1 0 0 0.5 0.5 0.5
v 0 1 0
v 0 0 1 # trailing
vt 0 0
vn 0 0 1
o first wall
usemtl nothing
f 1 2 3
l 1 2 3
f -4/9 -1//7 -3/1/1
  g second
p 1
f 1 2 4 3
";

/// Lines that are nearly right.
const WORDS: &str = "(v|f|o|g|l|vt|vn|usemtl)?( ?[-/0-9.e#]{1,5}| nan| 9223372036854775807\
    | -9223372036854775808| \\u{a0}){0,5}";

fn load_model(bytes: &[u8], up: Up) -> Result<Model, ObjError> {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(bytes).unwrap();
    load(file.path(), up)
}

pub(super) fn load_bytes(bytes: &[u8], up: Up) -> Result<Mesh, ObjError> {
    load_model(bytes, up).map(|model| model.mesh)
}

/// The line at fault and what is wrong with it.
pub(super) fn problem(text: &str) -> (usize, ObjProblem) {
    match load_bytes(text.as_bytes(), Up::Y) {
        Err(ObjError::Line { line, problem, .. }) => (line, problem),
        other => panic!("no line at fault: {other:?}"),
    }
}

#[test]
fn objects_and_groups_keep_their_names_and_polygons_become_triangles() {
    let mesh = load_bytes(CUBE_CORNER.as_bytes(), Up::Y).unwrap();
    let names: Vec<_> = mesh.objects.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["first wall", "second"]);
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 3, 1], [4, 5, 6], [4, 7, 5]]);
    assert_eq!(
        (
            mesh.objects[1].vertices.clone(),
            mesh.objects[1].triangles.clone()
        ),
        (4..8, 2..4)
    );
    assert_eq!(mesh.corners(2), [Vec3::ZERO, Vec3::Z, Vec3::Y]);
    assert_eq!(mesh.caster_object_count(), 2);
}

#[test]
fn z_up_is_turned_about_x() {
    let mesh = load_bytes(b"v 1 2 3\nv 0 0 1\nv 0 1 0\nf 1 2 3\n", Up::Z).unwrap();
    assert_eq!(
        mesh.corners(0),
        [Vec3::new(1.0, 3.0, -2.0), Vec3::Y, Vec3::NEG_Z]
    );
}

#[test]
fn equal_positions_are_welded_inside_an_object_and_degenerate_triangles_kept() {
    let mesh = load_bytes(
        b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 1e-42 0\nv 5 5 5\no a\nf 1 2 3\nf 4 3 1\no b\nf 1 2 3\n",
        Up::Y,
    );
    let mesh = mesh.unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 0], [3, 4, 5]]);
    assert_eq!(mesh.positions.len(), 6);
}

#[test]
fn weights_divide_and_other_line_ends_and_marks_do_not_matter() {
    let mesh = load_bytes(
        b"\xef\xbb\xbfv 2 4 6 2\r\nv 0 0 0\r\nv 1 0 0\r\ng caf\xe9\r\nf 1 2 3",
        Up::Y,
    );
    let mesh = mesh.unwrap();
    assert_eq!(mesh.positions[0], Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(mesh.objects[0].name, "caf\u{fffd}");
}

#[test]
fn a_line_at_fault_is_named() {
    use ObjProblem::{Coordinates, Index, NotFinite, Number, ShortFace, ZeroWeight};
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    assert_eq!(problem("v 0 0\nf 1 1 1"), (1, Coordinates(2)));
    assert_eq!(problem("\nv 0 x 0\nf 1 1 1"), (2, Number("x".to_owned())));
    assert_eq!(problem("v 0 0 0\nv 0 nan 0\nf 1 2 2"), (2, NotFinite));
    assert_eq!(problem("v 0 0 0\nv 0 1e99 0\nf 1 2 2"), (2, NotFinite));
    assert_eq!(problem("v 1 0 0 1e-44\nf 1 1 1"), (1, NotFinite));
    assert_eq!(problem("v 0 0 0 0\nf 1 1 1"), (1, ZeroWeight));
    assert_eq!(
        problem(&format!("{three}f 1 2 3\nf 1 2")),
        (5, ShortFace(2))
    );
    assert_eq!(problem(&format!("{three}f 1\n")), (4, ShortFace(1)));
    assert_eq!(problem(&format!("{three}f\n")), (4, ShortFace(0)));
    assert_eq!(
        problem(&format!("{three}f 1 2 4")),
        (
            4,
            Index {
                index: 4,
                vertices: 3
            }
        )
    );
    assert_eq!(
        problem(&format!("{three}f 1 2 0")),
        (
            4,
            Index {
                index: 0,
                vertices: 3
            }
        )
    );
    assert_eq!(
        problem(&format!("{three}f 1 2 -4")),
        (
            4,
            Index {
                index: -4,
                vertices: 3
            }
        )
    );
    assert_eq!(
        problem(&format!("{three}f 1 2 3/x")),
        (4, Number("3/x".to_owned()))
    );
    assert_eq!(
        problem(&format!("{three}f 1 2 3/1/1/1")),
        (4, Number("3/1/1/1".to_owned()))
    );
    let ahead = format!("{three}o a\nf 1 2 4\no b\nv 1 1 1\nf 1 2 4");
    assert_eq!(
        problem(&ahead),
        (
            5,
            Index {
                index: 4,
                vertices: 3
            }
        )
    );
}

#[test]
fn a_file_at_fault_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.obj");
    assert!(matches!(load(&missing, Up::Y), Err(ObjError::NotFound { path }) if path == missing));
    assert!(matches!(
        load(folder.path(), Up::Y),
        Err(ObjError::IsDirectory { .. })
    ));
    assert!(matches!(
        load_bytes(b"", Up::Y),
        Err(ObjError::Empty { .. })
    ));
    assert!(matches!(
        load_bytes(b"v 0 0 0\nl 1 1\n", Up::Y),
        Err(ObjError::NoFaces { .. })
    ));
    assert!(matches!(
        load_bytes(b"nothing of the kind\n", Up::Y),
        Err(ObjError::NoFaces { .. })
    ));
}

/// Also those that look like statements.
#[test]
fn names_are_kept_whatever_they_look_like() {
    for name in [
        "v 0 0",
        "f 1 2 9",
        "o",
        "g a",
        "usemtl  x",
        "mtllib y.mtl",
        "a  b\u{3000}c",
        "a\u{2028}b\u{85}c#",
        "C:\\",
        "unnamed_object",
    ] {
        let text = format!("v 0 0 0\no {name}\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng\nf 3 2 1\n");
        let mesh = load_bytes(text.as_bytes(), Up::Y).unwrap();
        let names: Vec<_> = mesh.objects.iter().map(|o| o.name.as_str()).collect();
        assert_eq!(names, [name.trim_end(), "unnamed_object"]);
    }
}

/// A quad whose fan from its first corner would leave the arrow's notch covered.
#[test]
fn an_arrow_has_one_shape_whichever_corner_comes_first() {
    let arrow = "v 0 1.5 -2\nv -1 1.5 .5\nv -2 1.5 -2\nv -1 1.5 -1.3\n";
    let spelled = |face: &str| load_model(format!("{arrow}{face}\n").as_bytes(), Up::Y).unwrap();
    let first = spelled("f 1 2 3 4");
    assert_eq!(first.notes, [""; 0]);
    let notch = Vec3::new(-1.0, 1.5, -1.3);
    for face in ["f 1 2 3 4", "f 2 3 4 1", "f 3 4 1 2", "f 4 1 2 3"] {
        let mesh = spelled(face).mesh;
        assert_eq!(mesh, first.mesh, "{face}");
        assert!(
            (0..2).all(|triangle| mesh.corners(triangle).contains(&notch)),
            "{face}"
        );
    }
}

#[test]
fn bent_and_crossing_polygons_are_noted() {
    let text = b"v 0 0 0\nv 1 0 0\nv 1 1 .3\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\nf 1 2 5 4\no x\nf 1 2 4 5\nf 1 2 3\n";
    let notes = load_model(text, Up::Y).unwrap().notes;
    assert_eq!(notes.len(), 2);
    assert!(
        notes[0].contains("1 of 3 polygons") && notes[0].contains("line 6"),
        "{}",
        notes[0]
    );
    assert!(
        notes[1].contains("1 of 3 polygons") && notes[1].contains("line 9"),
        "{}",
        notes[1]
    );
}

#[test]
fn words_that_are_no_statement_are_noted() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nF 1 2 3\n\u{feff}f 1 2 3\nvn 0 0 1\n";
    let notes = load_model(text.as_bytes(), Up::Y).unwrap().notes;
    assert_eq!(notes.len(), 1);
    assert!(
        notes[0].contains("2 statements") && notes[0].contains("`F` in line 5"),
        "{}",
        notes[0]
    );
}

#[test]
fn a_model_that_is_rounded_away_is_noted() {
    let notes = |size: &str| {
        let text = format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nf 1 2 3\n");
        load_model(text.as_bytes(), Up::Y).unwrap().notes
    };
    assert!(notes("1e-8").is_empty());
    for size in ["1e-10", "1e-13", "1e-30"] {
        assert!(notes(size)[0].contains("scale it up"), "{size}");
    }
}

#[test]
fn shapes_that_are_not_read_are_noted() {
    let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncstype bezier\nsurf 0 1 0 1 1 2 \\\n3\nend\ncall other.obj\n";
    let notes = load_model(text, Up::Y).unwrap().notes;
    assert_eq!(notes.len(), 1);
    assert!(
        notes[0].contains("2 statements") && notes[0].contains("`surf` in line 6"),
        "{}",
        notes[0]
    );
}

proptest! {
    /// Indices from the start and the end of the vertices, vertices that come after the face and before the next
    /// object, weights, colours, and lines that are not read.
    #[test]
    fn corners_are_the_vertices_that_faces_name(
        objects in prop::collection::vec(
            prop::collection::vec((any::<[u8; 3]>(), any::<[u8; 3]>(), 0u8..6), 1..8),
            1..6,
        ),
    ) {
        // Each object has three vertices behind its faces, which those may name as well as all before them.
        let mut text = String::new();
        let (mut vertices, mut expected) = (Vec::<Vec3>::new(), Vec::new());
        for (o, faces) in objects.iter().enumerate() {
            text += &format!("o {o}\nusemtl m{o}\nl 1 2\n");
            let own = [0, 1, 2].map(|i| Vec3::new(o as f32, f32::from(faces[0].1[i]), i as f32));
            let before = vertices.len();
            vertices.extend(own);
            for (picks, _, spelling) in faces {
                let corners = picks.map(|pick| usize::from(pick) % vertices.len());
                let spelled = corners.map(|v| match spelling {
                    1 if v < before => format!("-{}", before - v),
                    2 => format!("+{}/7/-9", v + 1),
                    3 => format!("{}//", v + 1),
                    _ => format!("{}", v + 1),
                });
                let between = if *spelling == 4 { " \\\n" } else { " " };
                text += &format!("f {}\n", spelled.join(between));
                expected.push(corners);
            }
            for (p, (_, _, spelling)) in own.iter().zip(faces.iter().cycle()) {
                text += &match spelling {
                    0 => format!("v {} {} {} 2\n", 2.0 * p.x, 2.0 * p.y, 2.0 * p.z),
                    1 => format!("v {:e} {} {} .1 .2 .3\n", p.x, p.y, p.z),
                    2 => format!("v {} {} \\\n{} 0 0 # C\n", p.x, p.y, p.z),
                    _ => format!("v +{} {} {}.\n", p.x, p.y, p.z),
                };
            }
        }
        let mesh = load_bytes(text.as_bytes(), Up::Y).unwrap();
        let expected: Vec<_> = expected.iter().map(|face| face.map(|v| vertices[v])).collect();
        let corners: Vec<_> = (0..mesh.triangles.len()).map(|t| mesh.corners(t)).collect();
        prop_assert_eq!(corners, expected, "{}", text);
        let counts = mesh.objects.iter().map(|object| object.triangles.len());
        prop_assert!(counts.eq(objects.iter().map(Vec::len)));
    }

    #[test]
    fn no_bytes_make_it_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = load_bytes(&bytes, Up::Y);
    }

    #[test]
    fn no_words_make_it_panic(
        lines in prop::collection::vec(WORDS, 0..20),
    ) {
        let _ = load_bytes(lines.join("\n").as_bytes(), Up::Z);
    }

    #[test]
    fn no_damage_to_a_good_file_makes_it_panic(
        damage in prop::collection::vec((0..CUBE_CORNER.len(), any::<u8>(), 0u8..3), 1..6),
    ) {
        let mut bytes = CUBE_CORNER.as_bytes().to_vec();
        for (place, byte, kind) in damage {
            let place = place.min(bytes.len() - 1);
            match kind {
                0 => bytes[place] = byte,
                1 => bytes.insert(place, byte),
                _ => bytes.truncate(place.max(1)),
            }
        }
        if let Ok(mesh) = load_bytes(&bytes, Up::Y) {
            prop_assert!(mesh.positions.iter().all(|p| p.is_finite()));
        }
    }
}
