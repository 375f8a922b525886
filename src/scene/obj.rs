//! Meshes from Wavefront OBJ files.
//!
//! The `tobj` crate does the parsing. It sees only the lines that make triangles: a polyline (`l`)
//! would become a polygon, a change of material would cut an object in two, colours on some of the
//! vertices and wild normal or texture indices would be errors, and none of that matters here.
//! It names no lines in its errors; `obj_diagnosis` finds them once something is wrong.

use std::path::{Path, PathBuf};
use std::{fs, io};

use glam::Vec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::mesh::{MAX_TRIANGLES, Mesh};
pub use super::obj_diagnosis::ObjProblem;
use super::obj_diagnosis::diagnose;
use super::part::Part;

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
    /// The parser refused the file and no line could be found at fault.
    #[error("{}: not a usable OBJ file; export it again as plain polygons", path.display())]
    Rejected {
        /// The path asked for.
        path: PathBuf,
        /// What the parser says.
        source: tobj::LoadError,
    },
}

/// Loads a model: polygons become triangle fans, each object or group an [`Part`], and the
/// vertices of an object that are at the same place become one. Material files are not read.
pub fn load(path: &Path, up: Up) -> Result<Mesh, ObjError> {
    let bytes = read(path)?;
    // In a file that is otherwise valid, only names can be in another encoding.
    let text = String::from_utf8(bytes)
        .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
    let lines = geometry_lines(&text);
    drop(text);
    let at_fault = |or_else: Option<tobj::LoadError>| match (diagnose(&lines), or_else) {
        (Some((line, problem)), _) => ObjError::Line {
            path: path.to_owned(),
            line,
            problem,
        },
        (None, Some(source)) => ObjError::Rejected {
            path: path.to_owned(),
            source,
        },
        (None, None) => ObjError::NoFaces {
            path: path.to_owned(),
        },
    };

    let options = tobj::LoadOptions::default();
    let no_materials = |_: &Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut lines.as_bytes(), &options, no_materials)
        .map_err(|error| at_fault(Some(error)))?;
    let parts: Option<Vec<Part>> = models.par_iter().map(|model| part(model, up)).collect();
    let parts = parts.ok_or_else(|| at_fault(Some(tobj::LoadError::InvalidPolygon)))?;

    match parts.iter().map(|part| part.triangles.len()).sum() {
        0 => Err(at_fault(None)),
        // The parser ends with an object that may be empty.
        1..=MAX_TRIANGLES => Ok(parts.into_iter().collect()),
        triangles => Err(ObjError::TooLarge {
            path: path.to_owned(),
            triangles,
        }),
    }
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

/// The file with all lines blank that make no triangles, so that lines keep their numbers.
fn geometry_lines(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    for line in text.trim_start_matches('\u{feff}').lines() {
        push_geometry(line.trim(), &mut kept);
        kept.push('\n');
    }
    kept
}

fn push_geometry(line: &str, kept: &mut String) {
    let without_comment = || line.split('#').next().unwrap_or_default();
    match line.split_whitespace().next() {
        Some("o" | "g") => kept.push_str(line),
        Some("f") => kept.push_str(without_comment()),
        // Behind x, y, z may stand a weight, which counts, or a colour, which does not.
        Some("v") if without_comment().split_whitespace().count() > 5 => {
            for word in line.split_whitespace().take(4) {
                kept.push_str(word);
                kept.push(' ');
            }
        }
        Some("v") => kept.push_str(without_comment()),
        _ => {}
    }
}

/// None if a face has fewer than three corners or a vertex is not finite.
fn part(model: &tobj::Model, up: Up) -> Option<Part> {
    let turned = |p: &[f32; 3]| match (up, *p) {
        (Up::Y, [x, y, z]) => Vec3::new(x, y, z),
        (Up::Z, [x, y, z]) => Vec3::new(x, z, -y),
    };
    let positions = model.mesh.positions.as_chunks().0;
    let positions: Vec<Vec3> = positions.iter().map(turned).collect();
    if !positions.iter().all(|p| p.is_finite()) {
        return None;
    }
    let triangles = triangulated(&model.mesh.indices, &model.mesh.face_arities)?;
    Some(Part::new(&model.name, &positions, triangles))
}

/// Fans around the first corner of each face; no arities mean triangles throughout.
fn triangulated(corners: &[u32], arities: &[u32]) -> Option<Vec<[u32; 3]>> {
    if arities.is_empty() {
        return Some(corners.as_chunks().0.to_vec());
    }
    let mut triangles = Vec::with_capacity(corners.len());
    let mut rest = corners;
    for &arity in arities {
        let (face, after) = rest.split_at_checked(arity as usize)?;
        rest = after;
        let [first, others @ ..] = face else {
            return None;
        };
        if others.len() < 2 {
            return None;
        }
        triangles.extend(others.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
    Some(triangles)
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
