//! Meshes from Wavefront OBJ files.
//!
//! Only what makes triangles is read: vertices, faces, objects and groups. A wild normal or texture index is
//! no error, for it does not matter here. Every statement is checked first, and named with its line if it
//! cannot be used; of vertices, faces and names the `tobj` crate then builds the objects.

use std::path::{Path, PathBuf};
use std::{fs, io};

use glam::Vec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::mesh::{MAX_TRIANGLES, Mesh, canonical};
use super::obj_checks::{self, Checked};
use super::obj_notes::{Shapes, size_note, unread_note};
pub use super::obj_problem::ObjProblem;
use super::obj_text;
use super::other_kind::other_kind;
use super::part::Part;
use super::polygon;

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
    if let Some((what, advice)) = other_kind(&bytes) {
        let path = path.to_owned();
        return Err(ObjError::OtherKind { path, what, advice });
    }
    let checked = match obj_text::damage(&bytes) {
        Some(damage) => Err(damage),
        // In a file that is otherwise valid, only names can be in another encoding.
        None => obj_checks::check(&String::from_utf8_lossy(&bytes)),
    };
    drop(bytes);
    let checked = checked.map_err(|(line, problem)| ObjError::Line {
        path: path.to_owned(),
        line,
        problem,
    })?;
    let (parts, shapes): (Vec<Part>, Vec<Shapes>) = objects(&checked)
        .par_iter()
        .map(|object| object.part(up))
        .unzip();
    match parts.iter().map(|part| part.triangles.len()).sum() {
        0 => Err(ObjError::NoFaces {
            path: path.to_owned(),
        }),
        1..=MAX_TRIANGLES => {
            let shapes = shapes.into_iter().fold(Shapes::default(), Shapes::and);
            let mut notes = shapes.notes(path);
            notes.extend(unread_note(path, &checked));
            notes.extend(size_note(path, size(&parts)));
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

/// The longest side of the box around all.
fn size(parts: &[Part]) -> f32 {
    let vertices = || parts.iter().flat_map(|part| &part.positions);
    let low = vertices().fold(Vec3::INFINITY, |low, p| low.min(*p));
    let high = vertices().fold(Vec3::NEG_INFINITY, |high, p| high.max(*p));
    (high - low).max_element()
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

/// An object or group: polygons of its own vertices.
struct ObjObject<'a> {
    model: tobj::Model,
    /// Where each polygon is written.
    lines: &'a [usize],
}

/// The objects of a checked text, in order. The last may be empty.
///
/// # Panics
/// When a check has let pass what `tobj` refuses.
fn objects(checked: &Checked) -> Vec<ObjObject<'_>> {
    let as_written = tobj::LoadOptions::default();
    let no_materials = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut checked.text.as_bytes(), &as_written, no_materials)
        .expect("tobj reads what was checked");
    let mut rest = checked.face_lines.as_slice();
    let object = |model: tobj::Model| {
        let mesh = &model.mesh;
        let polygons = match mesh.face_arities.len() {
            0 => mesh.indices.len() / 3,
            polygons => polygons,
        };
        let (lines, after) = rest.split_at(polygons);
        rest = after;
        ObjObject { model, lines }
    };
    models.into_iter().map(object).collect()
}

impl ObjObject<'_> {
    fn part(&self, up: Up) -> (Part, Shapes) {
        let mesh = &self.model.mesh;
        let positions = mesh.positions.as_chunks().0.iter();
        let positions: Vec<Vec3> = positions.map(|p| canonical(up.turned(*p))).collect();
        let mut triangles = Vec::with_capacity(mesh.indices.len() - 2 * self.lines.len());
        let mut shapes = Shapes::default();
        let mut rest = mesh.indices.as_slice();
        for (polygon, line) in self.lines.iter().enumerate() {
            // Where all are triangles, nothing is said of how many corners they have.
            let count = mesh.face_arities.get(polygon).unwrap_or(&3);
            let (corners, after) = rest.split_at(*count as usize);
            rest = after;
            let shape = polygon::triangulate(corners, &positions, &mut triangles);
            shapes = shapes.and(Shapes::of(shape, corners.len(), *line));
        }
        let part = Part::new(&self.model.name, &positions, triangles);
        (part, shapes)
    }
}

impl Up {
    fn turned(self, [x, y, z]: [f32; 3]) -> Vec3 {
        match self {
            Self::Y => Vec3::new(x, y, z),
            Self::Z => Vec3::new(x, z, -y),
        }
    }
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "obj_text_tests.rs"]
mod text_tests;
