//! The checks of an OBJ file, statement by statement.
//!
//! `tobj` builds objects and vertices, but only from a text that was checked here. It names no lines in its
//! errors, and of an unchecked text it would take NaN for a coordinate and a polyline for a polygon, cut an
//! object where its material changes, and refuse lines that go on, colours on some of the vertices and wild
//! normal or texture indices.

use glam::Vec3;

use super::mesh::LARGEST_COORDINATE;
use super::obj_problem::ObjProblem;
use super::obj_text::{self, AtLine, Statement};

/// What `tobj` is to read of a file, and what it cannot tell.
#[derive(Default)]
pub(super) struct Checked {
    /// Vertices, faces, objects and groups, each in one line, with their words as written. Not longer than
    /// the file.
    pub(super) text: String,
    /// The line of the file on which each face begins, in order.
    pub(super) face_lines: Vec<usize>,
    /// How many statements are not read that make shapes, or are none of the format's.
    pub(super) unread: usize,
    /// The first of them, and its line.
    pub(super) first_unread: Option<(usize, String)>,
}

/// Statements that need not be read: by themselves they make no shapes. Others do (curved surfaces, other files), or are
/// none of the format's.
const WITHOUT_SHAPE: &[&str] = &[
    "vt",
    "vn",
    "vp",
    "p",
    "l",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "deg",
    "cstype",
    "bmat",
    "step",
    "curv",
    "curv2",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "scmp",
    "res",
    "cdc",
    "tessellation",
    "evaluate",
];

/// Checks a text; what it returns, `tobj` reads without an error.
pub(super) fn check(text: &str) -> Result<Checked, AtLine> {
    let mut checker = Checker::default();
    checker.checked.text.reserve_exact(text.len() + 1);
    let mut too_early = None;
    for statement in obj_text::statements(text) {
        let statement = statement?;
        match statement.keyword {
            "v" => checker.vertex(&statement)?,
            "f" | "fo" => checker.face(&statement)?,
            "o" | "g" => {
                too_early = too_early.or(checker.end_object().err());
                checker.write("o", [statement.rest]);
            }
            keyword if !WITHOUT_SHAPE.contains(&keyword) => {
                let first = (statement.line, keyword.to_owned());
                checker.checked.unread += 1;
                checker.checked.first_unread.get_or_insert(first);
            }
            _ => {}
        }
    }
    match too_early.or(checker.end_object().err()) {
        Some(problem) => Err(problem),
        None => Ok(checker.checked),
    }
}

#[derive(Default)]
struct Checker {
    /// How many have come so far.
    vertices: usize,
    /// Vertices that the object under way names before they come, and what is wrong if they do not come before
    /// the next object.
    ahead: Vec<(usize, AtLine)>,
    checked: Checked,
}

impl Checker {
    fn vertex(&mut self, statement: &Statement<'_>) -> Result<(), AtLine> {
        let numbers = statement.words.iter();
        let numbers: Vec<f32> = numbers
            .map(|&(line, word)| number(word).map_err(|problem| (line, problem)))
            .collect::<Result<_, _>>()?;
        let at_line = |problem| (statement.line, problem);
        let &[x, y, z, ref others @ ..] = numbers.as_slice() else {
            return Err(at_line(ObjProblem::Coordinates(numbers.len())));
        };
        // Behind x, y, z may stand a weight, which counts, or a colour, which does not.
        let (weight, read) = match others {
            [weight] => (*weight, 4),
            _ => (1.0, 3),
        };
        if weight == 0.0 {
            return Err(at_line(ObjProblem::ZeroWeight));
        }
        let position = Vec3::new(x, y, z) / weight;
        if !position.is_finite() {
            return Err(at_line(ObjProblem::NotFinite));
        }
        if position.abs().max_element() > LARGEST_COORDINATE {
            return Err(at_line(ObjProblem::TooLarge));
        }
        self.vertices += 1;
        self.write("v", statement.words[..read].iter().map(|(_, word)| *word));
        Ok(())
    }

    fn face(&mut self, statement: &Statement<'_>) -> Result<(), AtLine> {
        let vertices = self.vertices;
        for &(line, word) in &statement.words {
            let index = index(word).map_err(|problem| (line, problem))?;
            let wrong = (line, ObjProblem::Index { index, vertices });
            match index.unsigned_abs() {
                0 => return Err(wrong),
                vertex if vertex <= vertices => {}
                vertex if index > 0 => self.ahead.push((vertex, wrong)),
                _ => return Err(wrong),
            }
        }
        let count = statement.words.len();
        if count < 3 {
            return Err((statement.line, ObjProblem::ShortFace(count)));
        }
        self.checked.face_lines.push(statement.line);
        self.write("f", statement.words.iter().map(|(_, word)| position(word)));
        Ok(())
    }

    /// `tobj` looks the vertices of an object up when the next one begins.
    fn end_object(&mut self) -> Result<(), AtLine> {
        let vertices = self.vertices;
        match self.ahead.drain(..).find(|(vertex, _)| *vertex > vertices) {
            Some((_, wrong)) => Err(wrong),
            None => Ok(()),
        }
    }

    fn write<'a>(&mut self, keyword: &str, words: impl IntoIterator<Item = &'a str>) {
        let text = &mut self.checked.text;
        text.push_str(keyword);
        for word in words {
            text.push(' ');
            text.push_str(word);
        }
        text.push('\n');
    }
}

/// A finite number, in any spelling that Rust reads; other spellings are refused.
fn number(word: &str) -> Result<f32, ObjProblem> {
    match word.parse::<f32>() {
        Ok(number) if number.is_finite() => Ok(number),
        Err(_) if !spells_not_finite(word) => Err(ObjProblem::Number(shown(word))),
        _ => Err(ObjProblem::NotFinite),
    }
}

/// Whether some C library writes NaN or infinity so: `-nan(ind)`, `1.#QNAN`, `1#INF`.
fn spells_not_finite(word: &str) -> bool {
    let word = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    let words = ["nan", "inf", "qnan", "snan", "1.#", "1#", "-1.#"];
    words.iter().any(|spelling| word.starts_with(spelling))
}

/// The first number of `v`, `v/t`, `v//n` or `v/t/n`; the others must be numbers if they are there.
fn index(corner: &str) -> Result<isize, ObjProblem> {
    let others = corner.split('/').skip(1);
    let is_optional = |part: &str| part.is_empty() || part.parse::<isize>().is_ok();
    match position(corner).parse() {
        Ok(index) if others.clone().count() <= 2 && others.clone().all(is_optional) => Ok(index),
        _ => Err(ObjProblem::Number(shown(corner))),
    }
}

/// What a corner says of its position.
fn position(corner: &str) -> &str {
    corner.split('/').next().unwrap_or_default()
}

/// As much of a word as a message has room for.
fn shown(word: &str) -> String {
    const MOST: usize = 40;
    match word.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}
