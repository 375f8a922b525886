//! Finds the line of an OBJ file that is at fault, after loading it has failed.

use std::fmt;

/// What is wrong with a line.
#[derive(Clone, Debug, PartialEq)]
pub enum ObjProblem {
    /// Something else stands where a number should.
    Number(String),
    /// A vertex with fewer than three coordinates.
    Coordinates(usize),
    /// A coordinate is NaN, infinite or too large for 32 bits.
    NotFinite,
    /// A vertex with a weight of 0, which lies at infinity.
    ZeroWeight,
    /// A face with fewer than three corners.
    ShortFace(usize),
    /// A face names a vertex that is not there.
    Index {
        /// The index as written, from 1, or from -1 backwards.
        index: isize,
        /// How many vertices precede the face.
        vertices: usize,
    },
}

impl fmt::Display for ObjProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(word) => write!(
                f,
                "`{word}` is not a number that belongs here; correct the line"
            ),
            Self::Coordinates(count) => {
                write!(
                    f,
                    "a vertex needs three coordinates, not {count}; complete the line"
                )
            }
            Self::NotFinite => f.write_str(
                "a coordinate is not a finite 32-bit number; repair the model and export it again",
            ),
            Self::ZeroWeight => {
                f.write_str("a vertex with weight 0 lies at infinity; remove the fourth number")
            }
            Self::ShortFace(count) => {
                write!(
                    f,
                    "a face needs at least three corners, not {count}; remove it or make it a \
                     line (`l`)"
                )
            }
            Self::Index { index, vertices } => write!(
                f,
                "the face names vertex {index}, but {vertices} vertices precede it; the file may \
                 be cut short"
            ),
        }
    }
}

/// The first line, counted from 1, that cannot be used; the text holds only `v`, `f`, `o` and `g`.
///
/// A vertex that only follows its face comes second: the parser takes it if it belongs to the same
/// object.
pub(super) fn diagnose(text: &str) -> Option<(usize, ObjProblem)> {
    let mut vertices = 0;
    let mut ahead = None;
    for (line, number) in text.lines().zip(1..) {
        let mut words = line.split_whitespace();
        let problem = match words.next() {
            Some("v") => {
                vertices += 1;
                vertex_problem(words)
            }
            Some("f") => face_problem(words, vertices),
            _ => None,
        };
        match problem {
            Some(ObjProblem::Index { index, .. }) if index > 0 => {
                ahead = ahead.or_else(|| problem.map(|problem| (number, problem)));
            }
            Some(problem) => return Some((number, problem)),
            None => {}
        }
    }
    ahead
}

fn vertex_problem<'a>(words: impl Iterator<Item = &'a str>) -> Option<ObjProblem> {
    let mut numbers = Vec::new();
    for word in words {
        match word.parse::<f32>() {
            Ok(number) => numbers.push(number),
            Err(_) => return Some(ObjProblem::Number(word.to_owned())),
        }
    }
    let weight = numbers.get(3).copied().unwrap_or(1.0);
    match numbers.len() {
        count @ 0..3 => Some(ObjProblem::Coordinates(count)),
        _ if weight == 0.0 => Some(ObjProblem::ZeroWeight),
        _ => numbers[..3]
            .iter()
            .any(|x| !(x / weight).is_finite())
            .then_some(ObjProblem::NotFinite),
    }
}

fn face_problem<'a>(corners: impl Iterator<Item = &'a str>, vertices: usize) -> Option<ObjProblem> {
    let mut count = 0;
    for corner in corners {
        count += 1;
        // Position, and then optionally texture and normal: v, v/t, v//n or v/t/n.
        let parts: Vec<&str> = corner.split('/').collect();
        let is_index = |part: &&str| part.parse::<isize>().is_ok();
        let optional = parts.get(1..).unwrap_or_default();
        if parts.len() > 3
            || !optional
                .iter()
                .all(|part| part.is_empty() || is_index(part))
        {
            return Some(ObjProblem::Number(corner.to_owned()));
        }
        let Ok(index) = parts[0].parse::<isize>() else {
            return Some(ObjProblem::Number(corner.to_owned()));
        };
        if index == 0 || index.unsigned_abs() > vertices {
            return Some(ObjProblem::Index { index, vertices });
        }
    }
    (count < 3).then_some(ObjProblem::ShortFace(count))
}
