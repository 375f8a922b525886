//! The vertices and faces of an OBJ file, statement by statement.

use glam::Vec3;

use super::mesh::{LARGEST_COORDINATE, canonical};
use super::obj::Up;
use super::obj_problem::ObjProblem;
use super::obj_text::{self, AtLine, Statement};

/// An object or group as it is written: polygons of its own vertices.
#[derive(Default)]
pub(super) struct Object {
    pub(super) name: String,
    /// Canonical.
    pub(super) positions: Vec<Vec3>,
    pub(super) corners: Vec<u32>,
    pub(super) polygons: Vec<Polygon>,
}

/// All that is read of a file.
#[derive(Default)]
pub(super) struct ObjText {
    /// Those with faces, in order.
    pub(super) objects: Vec<Object>,
    /// How many statements are not read that make shapes.
    pub(super) unread: usize,
    /// The first of them, and its line.
    pub(super) first_unread: Option<(usize, String)>,
}

/// Statements that are not read though they make shapes: curved surfaces, and other files.
const UNREAD: &[&str] = &["surf", "bzp", "bsp", "cdp", "call", "csh"];

/// Some corners of an [`Object`].
pub(super) struct Polygon {
    /// How many, at least three.
    pub(super) corners: usize,
    /// Where it is written.
    pub(super) line: usize,
}

/// Reads statement by statement.
pub(super) struct Reader {
    up: Up,
    /// Of the whole file.
    vertices: Vec<Vec3>,
    /// Where each vertex is in the object under way, or [`UNUSED`].
    places: Vec<u32>,
    object: Object,
    /// The vertices of the object under way.
    used: Vec<usize>,
    /// Corners of the object under way that name a vertex which did not come yet: where they are in its
    /// corners, the vertex, and what is wrong if it does not come before the next object.
    ahead: Vec<(usize, usize, AtLine)>,
    text: ObjText,
}

const UNUSED: u32 = u32::MAX;

/// What an object is called that has no name.
const UNNAMED: &str = "unnamed_object";

impl Reader {
    /// What a text holds.
    pub(super) fn read(text: &str, up: Up) -> Result<ObjText, AtLine> {
        let mut reader = Self {
            up,
            vertices: Vec::new(),
            places: Vec::new(),
            object: Object::default(),
            used: Vec::new(),
            ahead: Vec::new(),
            text: ObjText::default(),
        };
        let mut too_early = None;
        for statement in obj_text::statements(text) {
            let statement = statement?;
            match statement.keyword {
                "v" => reader.vertex(&statement)?,
                "f" | "fo" => reader.face(&statement)?,
                "o" | "g" => {
                    too_early = too_early.or(reader.end_object().err());
                    reader.object.name = statement.rest.to_owned();
                }
                keyword if UNREAD.contains(&keyword) => {
                    let first = (statement.line, keyword.to_owned());
                    reader.text.unread += 1;
                    reader.text.first_unread.get_or_insert(first);
                }
                _ => {}
            }
        }
        match too_early.or(reader.end_object().err()) {
            Some(problem) => Err(problem),
            None => Ok(reader.text),
        }
    }

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
        let weight = if let [weight] = others { *weight } else { 1.0 };
        if weight == 0.0 {
            return Err(at_line(ObjProblem::ZeroWeight));
        }
        let position = match self.up {
            Up::Y => Vec3::new(x, y, z),
            Up::Z => Vec3::new(x, z, -y),
        } / weight;
        if !position.is_finite() {
            return Err(at_line(ObjProblem::NotFinite));
        }
        if position.abs().max_element() > LARGEST_COORDINATE {
            return Err(at_line(ObjProblem::TooLarge));
        }
        self.vertices.push(canonical(position));
        self.places.push(UNUSED);
        Ok(())
    }

    fn face(&mut self, statement: &Statement<'_>) -> Result<(), AtLine> {
        let count = statement.words.len();
        for &(line, word) in &statement.words {
            let index = index(word).map_err(|problem| (line, problem))?;
            let vertices = self.vertices.len();
            let wrong = (line, ObjProblem::Index { index, vertices });
            let vertex = match index {
                1.. => index.unsigned_abs() - 1,
                _ => match vertices.checked_sub(index.unsigned_abs()) {
                    Some(vertex) if index < 0 => vertex,
                    _ => return Err(wrong),
                },
            };
            let corner = if vertex < vertices {
                self.place(vertex)
            } else {
                self.ahead.push((self.object.corners.len(), vertex, wrong));
                UNUSED
            };
            self.object.corners.push(corner);
        }
        if count < 3 {
            return Err((statement.line, ObjProblem::ShortFace(count)));
        }
        self.object.polygons.push(Polygon {
            corners: count,
            line: statement.line,
        });
        Ok(())
    }

    /// Where a vertex is in the object under way.
    fn place(&mut self, vertex: usize) -> u32 {
        if self.places[vertex] == UNUSED {
            self.places[vertex] = self.used.len() as u32;
            self.used.push(vertex);
            self.object.positions.push(self.vertices[vertex]);
        }
        self.places[vertex]
    }

    fn end_object(&mut self) -> Result<(), AtLine> {
        for (corner, vertex, wrong) in std::mem::take(&mut self.ahead) {
            if vertex >= self.vertices.len() {
                return Err(wrong);
            }
            self.object.corners[corner] = self.place(vertex);
        }
        for vertex in self.used.drain(..) {
            self.places[vertex] = UNUSED;
        }
        let mut object = std::mem::take(&mut self.object);
        if object.name.is_empty() {
            object.name = UNNAMED.to_owned();
        }
        if !object.polygons.is_empty() {
            self.text.objects.push(object);
        }
        Ok(())
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
    let mut parts = corner.split('/');
    let position = parts.next().and_then(|part| part.parse().ok());
    let is_optional = |part: &str| part.is_empty() || part.parse::<isize>().is_ok();
    match position {
        Some(index) if parts.clone().count() <= 2 && parts.all(is_optional) => Ok(index),
        _ => Err(ObjProblem::Number(shown(corner))),
    }
}

/// As much of a word as a message has room for.
fn shown(word: &str) -> String {
    const MOST: usize = 40;
    match word.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &word[..end]),
        None => word.to_owned(),
    }
}
