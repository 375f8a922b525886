//! Scene files as they are written: what serde reads, and its checks. Errors keep their places.

mod flight;
mod mesh;
mod sun;

use std::fs;
use std::ops::Range;
use std::path::Path;

use serde::Deserialize;
use toml::Spanned;

use self::flight::{CameraWire, LightWire};
use self::mesh::MeshWire;
use super::file::{Expect, SceneFile};
use super::flight::Flight;
use super::scene_error::SceneError;
use crate::toml_error;

impl SceneFile {
    /// Reads and checks a scene file.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let text = fs::read_to_string(path).map_err(|source| SceneError::Read {
            path: path.to_owned(),
            source,
        })?;
        Self::parse(&text, &path.to_string_lossy())
    }

    /// Checks the text of a scene file. Errors name the file so; the scene is named after its stem.
    pub fn parse(text: &str, name_for_errors: &str) -> Result<Self, SceneError> {
        let wire: FileWire = toml::from_str(text).map_err(|error| {
            SceneError::Invalid(toml_error::describe(&error, text, name_for_errors))
        })?;
        let stem = Path::new(name_for_errors).file_stem().unwrap_or_default();
        let place = |span: &Range<usize>| toml_error::place(span, text, name_for_errors);
        wire.check(stem.to_string_lossy().into_owned(), &place)
            .map_err(|Misplaced { span, message }| {
                SceneError::Invalid(toml_error::at(&span, &message, text, name_for_errors))
            })
    }
}

/// Something that cannot be, and the part of the text that says it.
struct Misplaced {
    span: Range<usize>,
    message: String,
}

fn misplaced<T>(what: &Spanned<T>, message: &impl ToString) -> Misplaced {
    Misplaced {
        span: what.span(),
        message: message.to_string(),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileWire {
    title: String,
    mesh: MeshWire,
    expect: Option<Expect>,
    light: Spanned<LightWire>,
    camera: CameraWire,
}

impl FileWire {
    /// `place` says in words where a span is, for what only the model can show to be wrong.
    fn check(
        self,
        name: String,
        place: &dyn Fn(&Range<usize>) -> String,
    ) -> Result<SceneFile, Misplaced> {
        let mesh = self.mesh.check(place)?;
        let camera_unit = self.camera.unit;
        let camera = self.camera.check()?;
        Ok(SceneFile {
            name,
            title: self.title,
            mesh,
            expect: self.expect,
            camera_unit,
            flight: Flight {
                light: LightWire::check(&self.light, camera.duration_s())?,
                camera,
            },
        })
    }
}
