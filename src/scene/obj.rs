//! Meshes from Wavefront OBJ files.
//!
//! Only what makes triangles is read: vertices, faces, objects and groups. A wild normal or texture index is
//! no error, for it does not matter here.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::{fs, io};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::mesh::{MAX_TRIANGLES, Mesh};
pub use super::obj_problem::ObjProblem;
use super::obj_reader::{ObjText, Object, Polygon, Reader};
use super::obj_text;
use super::part::Part;
use super::polygon::{self, Shape};

/// Which axis of a model points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Up {
    /// As in this program: nothing is turned.
    #[default]
    Y,
    /// The model is turned about the x axis: (x, y, z) becomes (x, z, -y).
    Z,
}

/// Why a model could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum ObjError {
    /// There is no such file.
    #[error("{}: no such file; check the path", path.display())]
    NotFound {
        /// The path asked for.
        path: PathBuf,
    },
    /// The path is that of a folder.
    #[error("{}: is a directory; name the OBJ file in it", path.display())]
    IsDirectory {
        /// The path asked for.
        path: PathBuf,
    },
    /// The file is there but could not be read.
    #[error("{}: cannot be read", path.display())]
    Read {
        /// The path asked for.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file has no bytes.
    #[error("{}: is empty; export or download it again", path.display())]
    Empty {
        /// The path asked for.
        path: PathBuf,
    },
    /// The file has no triangles.
    #[error(
        "{}: has no faces; is it an OBJ file, with polygons and not only points or lines?",
        path.display()
    )]
    NoFaces {
        /// The path asked for.
        path: PathBuf,
    },
    /// A line cannot be used.
    #[error("{}:{line}: {problem}", path.display())]
    Line {
        /// The path asked for.
        path: PathBuf,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it.
        problem: ObjProblem,
    },
    /// More triangles than 32-bit indices reach.
    #[error(
        "{}: has {triangles} triangles, more than {MAX_TRIANGLES}; split or simplify it",
        path.display()
    )]
    TooLarge {
        /// The path asked for.
        path: PathBuf,
        /// How many it has.
        triangles: usize,
    },
    /// It is a file of another kind.
    #[error("{}: is {what}, no OBJ file; {advice}", path.display())]
    OtherKind {
        /// The path asked for.
        path: PathBuf,
        /// What it is.
        what: &'static str,
        /// What to do about it.
        advice: &'static str,
    },
}

/// A model as it was read.
#[derive(Debug)]
pub struct Model {
    /// Its triangles.
    pub mesh: Mesh,
    /// What its reader should know: what of it could be read in more than one way.
    pub notes: Vec<String>,
}

/// Loads a model: polygons become triangles, each object or group a [`Part`], and the vertices of an object
/// that are at the same place become one. Material files are not read.
pub fn load(path: &Path, up: Up) -> Result<Model, ObjError> {
    let bytes = read(path)?;
    if let Some((what, advice)) = obj_text::other_kind(&bytes) {
        let path = path.to_owned();
        return Err(ObjError::OtherKind { path, what, advice });
    }
    let text = match obj_text::damage(&bytes) {
        Some(damage) => Err(damage),
        // In a file that is otherwise valid, only names can be in another encoding.
        None => Reader::read(&String::from_utf8_lossy(&bytes), up),
    };
    drop(bytes);
    let text = text.map_err(|(line, problem)| ObjError::Line {
        path: path.to_owned(),
        line,
        problem,
    })?;
    let (parts, shapes): (Vec<Part>, Vec<Shapes>) =
        text.objects.par_iter().map(Object::part).unzip();
    match parts.iter().map(|part| part.triangles.len()).sum() {
        0 => Err(ObjError::NoFaces {
            path: path.to_owned(),
        }),
        1..=MAX_TRIANGLES => {
            let shapes = shapes.into_iter().fold(Shapes::default(), Shapes::and);
            let mut notes = shapes.notes(path);
            notes.extend(unread_note(path, &text));
            Ok(Model {
                mesh: parts.into_iter().collect(),
                notes,
            })
        }
        triangles => Err(ObjError::TooLarge {
            path: path.to_owned(),
            triangles,
        }),
    }
}

/// What to say of statements that are not read.
fn unread_note(path: &Path, text: &ObjText) -> Option<String> {
    let (line, keyword) = text.first_unread.as_ref()?;
    Some(format!(
        "{}: {} statements for curved surfaces or other files are not read, the first of them `{keyword}` in line \
         {line}; export polygons",
        file_name(path),
        text.unread,
    ))
}

fn file_name(path: &Path) -> Cow<'_, str> {
    path.file_name().unwrap_or_default().to_string_lossy()
}

fn read(path: &Path) -> Result<Vec<u8>, ObjError> {
    // Reading a directory fails with a different error on each system: ask first.
    if path.is_dir() {
        return Err(ObjError::IsDirectory {
            path: path.to_owned(),
        });
    }
    match fs::read(path) {
        Ok(bytes) if bytes.is_empty() => Err(ObjError::Empty {
            path: path.to_owned(),
        }),
        Ok(bytes) => Ok(bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Err(ObjError::NotFound {
            path: path.to_owned(),
        }),
        Err(source) => Err(ObjError::Read {
            path: path.to_owned(),
            source,
        }),
    }
}

impl Object {
    fn part(&self) -> (Part, Shapes) {
        let mut triangles = Vec::with_capacity(self.corners.len() - 2 * self.polygons.len());
        let mut shapes = Shapes::default();
        let mut rest = self.corners.as_slice();
        for polygon in &self.polygons {
            let (corners, after) = rest.split_at(polygon.corners);
            rest = after;
            let shape = polygon::triangulate(corners, &self.positions, &mut triangles);
            shapes = shapes.and(Shapes::of(shape, polygon));
        }
        (Part::new(&self.name, &self.positions, triangles), shapes)
    }
}

/// What is to say of the polygons of a model.
#[derive(Clone, Copy, Debug, Default)]
struct Shapes {
    /// Those of more than three corners.
    polygons: usize,
    bent: usize,
    /// How much the one that is bent most is, and its line.
    most_bent: (f64, usize),
    crossing: usize,
    /// The line of the first.
    first_crossing: usize,
}

impl Shapes {
    fn of(shape: Shape, polygon: &Polygon) -> Self {
        let line = polygon.line;
        let mut shapes = Self {
            polygons: usize::from(polygon.corners > 3),
            ..Self::default()
        };
        match shape {
            Shape::Flat => {}
            Shape::Bent(by) => (shapes.bent, shapes.most_bent) = (1, (by, line)),
            Shape::Crossing => (shapes.crossing, shapes.first_crossing) = (1, line),
        }
        shapes
    }

    /// Of objects in the order of the file.
    fn and(self, next: Self) -> Self {
        let more_bent = next.most_bent.0 > self.most_bent.0;
        let first_crossing = [self.first_crossing, next.first_crossing];
        Self {
            polygons: self.polygons + next.polygons,
            bent: self.bent + next.bent,
            most_bent: if more_bent {
                next.most_bent
            } else {
                self.most_bent
            },
            crossing: self.crossing + next.crossing,
            first_crossing: first_crossing[usize::from(self.crossing == 0)],
        }
    }

    fn notes(&self, path: &Path) -> Vec<String> {
        let file = file_name(path);
        let some = |count: usize, one: &str, many: &str| {
            let (all, verb) = (self.polygons, if count == 1 { one } else { many });
            format!("{file}: {count} of {all} polygons of more than three corners {verb}")
        };
        let mut notes = Vec::new();
        if self.bent > 0 {
            let (by, line) = self.most_bent;
            notes.push(format!(
                "{} not flat, the worst by {:.1} % of its size (line {line}): how it is cut into \
                 triangles decides its shape; export triangles to decide that yourself",
                some(self.bent, "is", "are"),
                100.0 * by,
            ));
        }
        if self.crossing > 0 {
            notes.push(format!(
                "{} (the first in line {}): without an inside, each is drawn as a fan of triangles; \
                 repair them, or export triangles",
                some(self.crossing, "crosses itself", "cross themselves"),
                self.first_crossing,
            ));
        }
        notes
    }
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "obj_text_tests.rs"]
mod text_tests;
