use glam::Vec3;
use proptest::prelude::*;

use super::tests::{load_bytes, problem};
use super::*;

/// What a file is, and what to do about it.
fn other_kind(bytes: &[u8]) -> (&'static str, &'static str) {
    match load_bytes(bytes, Up::Y) {
        Err(ObjError::OtherKind { what, advice, .. }) => (what, advice),
        other => panic!("not seen: {other:?}"),
    }
}

/// As C libraries, Fortran, other languages and other countries write what is no finite number, and numbers
/// that are none here.
const NOT_FINITE: &[&str] = &[
    "nan",
    "NAN",
    "NaN",
    "-nan",
    "nan(ind)",
    "-nan(ind)",
    "nan(snan)",
    "nan(0x8000)",
    "NaNQ",
    "NaNS",
    "1.#IND",
    "-1.#IND",
    "1.#QNAN",
    "1.#SNAN",
    "1.#INF",
    "-1.#INF00",
    "1.#J",
    "-1.#IND000",
    "1#INF",
    "1#IND",
    "inf",
    "-inf",
    "+Inf",
    "INF",
    "Infinity",
    "-INFINITY",
    "∞",
    "1e999",
    "-1e39",
    "0x1p3",
    "0x10",
    "1d5",
    "1.0D+00",
    "1,5",
    "1.5f",
    "1_000",
    "1e",
    "e5",
    ".",
    "-",
    "+-1",
    "--1",
    "١",
    "−1",
    "1'000",
    "NULL",
    "null",
    "None",
    "undefined",
    "(1)",
    "1/2",
    "?",
    "****",
    "*",
    "1\u{0}",
];

#[test]
fn nothing_but_finite_numbers_is_a_coordinate() {
    for word in NOT_FINITE {
        for line in [
            format!("v {word} 0 0"),
            format!("v 0 0 {word}"),
            format!("v 0 0 0 {word} 0 0"),
        ] {
            // Also of a vertex that no face names.
            let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\nf 1 2 3\n");
            assert_eq!(problem(&text).0, 4, "{line}");
        }
    }
    assert_eq!(problem("v 1.#IND 0 0\n"), (1, ObjProblem::NotFinite));
    assert_eq!(
        problem("v 0 0 0\nv 0 -4.3e9 0\n"),
        (2, ObjProblem::TooLarge)
    );
    assert_eq!(problem("v 0 0 1.#QNAN\n"), (1, ObjProblem::NotFinite));
    let finite = load_bytes(b"v +1 .5 1.\nv 1E0 1e-999 -0\nv 0 1 00012\nf 1 2 3", Up::Y).unwrap();
    assert_eq!(
        finite.positions,
        [Vec3::new(1.0, 0.5, 1.0), Vec3::X, Vec3::new(0.0, 1.0, 12.0)]
    );
}

#[test]
fn a_comment_begins_where_a_word_begins() {
    let mesh = load_bytes(
        b"#v 9 9 9\nv 0 0 0 # v 1 1 1\nv 1 0 0\t#\nv 0 1 0\n g name#1 # C#\nf 1 2 3 #4\n",
        Up::Y,
    );
    let mesh = mesh.unwrap();
    assert_eq!(mesh.objects[0].name, "name#1");
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    let glued = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3#4\n";
    assert_eq!(problem(glued), (4, ObjProblem::Number("3#4".to_owned())));
}

#[test]
fn lines_of_numbers_go_on_and_names_and_comments_do_not() {
    let text = "v 0 0\\\n0\nv 1 \\\r\n 0 0 \\ \nv 0 1 0\n";
    assert_eq!(problem(text), (5, ObjProblem::Number("v".to_owned())));
    let text = "# C:\\\nv 0 0\\\n0\nv 1 \\\r\n 0 0\nv 0 1 0 # D:\\\nvt 0 \\\n 0\nv 1 1 0\no C:\\\n\
        usemtl E:\\\nf 1 2 \\\n4 \\\n3\nmtllib F:\\\nf 1 2 3\n";
    let mesh = load_bytes(text.as_bytes(), Up::Y).unwrap();
    assert_eq!((mesh.triangles.len(), mesh.positions.len()), (3, 4));
    assert_eq!(mesh.objects[0].name, "C:\\");
    // The words after a break have its line, and the lines after it keep theirs.
    assert_eq!(
        problem("v 0 0 \\\n0 \\\nx\n"),
        (3, ObjProblem::Number("x".to_owned()))
    );
    assert_eq!(
        problem("v 0 0 \\\n0\n\nv 0 0\n"),
        (4, ObjProblem::Coordinates(2))
    );
    assert_eq!(problem("v 0 0 0\nf 1 \\\n1 \\"), (3, ObjProblem::CutShort));
}

#[test]
fn a_line_that_lost_its_beginning_is_no_statement() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for line in [
        "0 0 1",
        "-1.5 2 3",
        "v1 0 0",
        "f1 2 3",
        "1/1/1 2/2/2 3/3/3",
        ".5 0 0",
    ] {
        let first = line.split(' ').next().unwrap_or_default().to_owned();
        let text = format!("{three}{line}\nf 1 2 3\n");
        assert_eq!(problem(&text), (4, ObjProblem::Stray(first)));
    }
}

#[test]
fn what_cannot_be_an_obj_file_is_told_as_what_it_is() {
    let utf16 = |swap: bool, mark: &str| -> Vec<u8> {
        let units = format!("{mark}v 0 0 0\n")
            .encode_utf16()
            .collect::<Vec<_>>();
        let bytes = |unit: u16| {
            if swap {
                unit.to_be_bytes()
            } else {
                unit.to_le_bytes()
            }
        };
        units.into_iter().flat_map(bytes).collect()
    };
    for bytes in [false, true]
        .into_iter()
        .flat_map(|s| ["", "\u{feff}"].map(|mark| utf16(s, mark)))
    {
        assert!(other_kind(&bytes).0.contains("UTF-16"));
    }
    let mut stl = vec![b'x'; 84 + 50];
    stl[80..84].copy_from_slice(&1u32.to_le_bytes());
    let cases: [(&[u8], &str); 12] = [
        (b"\x1f\x8b\x08\0\0", "gzip"),
        (b"PK\x03\x04\0\0", "zip"),
        (
            b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n",
            "Git LFS",
        ),
        (b"\xef\xbb\xbf\n <!DOCTYPE html><html>404", "HTML"),
        (b"<HTML><body>", "HTML"),
        (b"<?xml version='1.0'?><COLLADA>", "XML"),
        (b"ply\nformat binary_little_endian 1.0\n", "PLY"),
        (b"solid cube\nfacet normal 0 0 1\n", "STL"),
        (b"glTF\x02\0\0\0", "glTF"),
        (b"{\"asset\":{\"version\":\"2.0\"}}", "JSON"),
        (b"\x89PNG\r\n\x1a\n\0\0\0", "PNG"),
        (&stl, "STL"),
    ];
    for (bytes, word) in cases {
        let (what, advice) = other_kind(bytes);
        assert!(what.contains(word) && !advice.is_empty(), "{what}");
    }
    assert_eq!(
        problem("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"),
        (1, ObjProblem::CarriageReturn)
    );
    assert_eq!(
        problem("v 0 0 0\n# a\rv 1 0 0\n"),
        (2, ObjProblem::CarriageReturn)
    );
    assert_eq!(
        problem("v 0 0 0\nf 1 1 1\n\0\0\0"),
        (3, ObjProblem::ZeroByte)
    );
    load_bytes(b"v 0 0 0\r\r\nv 1 0 0\r\r\nv 0 1 0\r\r\nf 1 2 3\r", Up::Y).unwrap();
}

proptest! {
    /// What is no number is told with its line, wherever it stands and however the line is broken.
    #[test]
    fn what_is_no_number_is_told_with_its_line(
        word in prop::sample::select(NOT_FINITE),
        place in 0usize..3,
        breaks in prop::collection::vec(any::<bool>(), 3),
        comments in 0usize..4,
    ) {
        let mut text = "# C:\\models\\\n".repeat(comments) + "v";
        let mut at = comments + 1;
        for (i, &breaks) in breaks.iter().enumerate() {
            text += " ";
            if breaks {
                text += "\\\r\n";
            }
            at += usize::from(breaks && i <= place);
            text += if i == place { word } else { "1.5" };
        }
        text += "\nf 1 1 1\n";
        prop_assert_eq!(problem(&text).0, at, "{}", text);
    }
}
