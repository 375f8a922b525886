//! Scene files as they are written: what serde reads, and its checks. Errors keep their places.

mod flight;
mod mesh;

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;

use self::flight::{CameraWire, LightWire};
use self::mesh::MeshWire;
use super::file::{Expect, SceneFile};
use super::flight::Flight;

/// Something that cannot be, and the part of the text that says it.
pub(super) struct Misplaced {
    pub(super) span: Range<usize>,
    pub(super) message: String,
}

fn misplaced<T>(what: &Spanned<T>, message: &impl ToString) -> Misplaced {
    Misplaced {
        span: what.span(),
        message: message.to_string(),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileWire {
    title: String,
    mesh: MeshWire,
    expect: Option<Expect>,
    light: Spanned<LightWire>,
    camera: CameraWire,
}

impl FileWire {
    /// `place` says in words where a span is, for what only the model can show to be wrong.
    pub(super) fn check(
        self,
        name: String,
        place: &dyn Fn(&Range<usize>) -> String,
    ) -> Result<SceneFile, Misplaced> {
        Ok(SceneFile {
            name,
            title: self.title,
            mesh: self.mesh.check(place)?,
            expect: self.expect,
            flight: Flight {
                light: LightWire::check(&self.light)?,
                camera: self.camera.check()?,
            },
        })
    }
}
