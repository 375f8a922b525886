//! Scene files as they are written: what serde reads, and its checks. Errors keep their places.

use std::collections::HashSet;
use std::ops::Range;
use std::path::PathBuf;

use glam::{DVec3, Vec3, Vec4};
use serde::Deserialize;
use toml::Spanned;

use super::camera::{CameraKey, CameraPath};
use super::file::{Expect, MeshSource, Receiver, SceneFile};
use super::light::{LightError, light};
use super::obj::Up;
use super::sphere_grid::SphereGrid;
use super::view::{CameraError, radians};
use crate::toml_array::Exactly;

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
    light: LightWire,
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
            light: self.light.check()?,
            camera: self.camera.check()?,
        })
    }
}

#[derive(Clone, Copy, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum MeshKind {
    SphereGrid,
    Obj,
}

/// The keys of both kinds: an enum of tables would lose the places of errors.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MeshWire {
    kind: Spanned<MeshKind>,
    rows: Option<Spanned<u32>>,
    columns: Option<Spanned<u32>>,
    slices: Option<Spanned<u32>>,
    file: Option<Spanned<PathBuf>>,
    up: Option<Spanned<Up>>,
    source: Option<Spanned<String>>,
    receivers: Option<Spanned<Vec<Spanned<String>>>>,
}

impl MeshWire {
    fn check(self, place: &dyn Fn(&Range<usize>) -> String) -> Result<MeshSource, Misplaced> {
        let Self {
            kind,
            rows,
            columns,
            slices,
            file,
            up,
            source,
            receivers,
        } = self;
        let needed = |key: &str| misplaced(&kind, &format!("this kind of mesh needs `{key}`"));
        match *kind.get_ref() {
            MeshKind::SphereGrid => {
                let strangers = [
                    span_of("file", &file),
                    span_of("up", &up),
                    span_of("source", &source),
                    span_of("receivers", &receivers),
                ];
                refuse(&strangers, "obj")?;
                let grid = SphereGrid {
                    rows: rows.ok_or_else(|| needed("rows"))?.into_inner(),
                    columns: columns.ok_or_else(|| needed("columns"))?.into_inner(),
                    slices: slices.ok_or_else(|| needed("slices"))?.into_inner(),
                };
                grid.validate().map_err(|error| misplaced(&kind, &error))?;
                Ok(MeshSource::SphereGrid(grid))
            }
            MeshKind::Obj => {
                let strangers = [
                    span_of("rows", &rows),
                    span_of("columns", &columns),
                    span_of("slices", &slices),
                ];
                refuse(&strangers, "sphere_grid")?;
                Ok(MeshSource::Obj {
                    file: file.ok_or_else(|| needed("file"))?.into_inner(),
                    up: up.ok_or_else(|| needed("up"))?.into_inner(),
                    origin: source.map(Spanned::into_inner),
                    receivers: receivers.map_or(Ok(Vec::new()), |names| {
                        check_receivers(names.into_inner(), place)
                    })?,
                })
            }
        }
    }
}

fn check_receivers(
    names: Vec<Spanned<String>>,
    place: &dyn Fn(&Range<usize>) -> String,
) -> Result<Vec<Receiver>, Misplaced> {
    let mut receivers: Vec<Receiver> = Vec::with_capacity(names.len());
    let mut known = HashSet::with_capacity(names.len());
    for spanned in names {
        let name = spanned.get_ref().clone();
        if !known.insert(name.clone()) {
            return Err(misplaced(&spanned, &format!("`{name}` stands here twice")));
        }
        let place = place(&spanned.span());
        receivers.push(Receiver { name, place });
    }
    Ok(receivers)
}

fn span_of<T>(
    key: &'static str,
    value: &Option<Spanned<T>>,
) -> Option<(&'static str, Range<usize>)> {
    value.as_ref().map(|value| (key, value.span()))
}

fn refuse(
    keys: &[Option<(&'static str, Range<usize>)>],
    other_kind: &str,
) -> Result<(), Misplaced> {
    match keys.iter().flatten().next() {
        Some((key, span)) => {
            let message = format!("`{key}` belongs to kind = \"{other_kind}\"; remove it");
            let span = span.clone();
            Err(Misplaced { span, message })
        }
        None => Ok(()),
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LightWire {
    position: Spanned<Exactly<f64, 3>>,
    w: Option<Spanned<f64>>,
}

impl LightWire {
    fn check(self) -> Result<Vec4, Misplaced> {
        let position = DVec3::from_array(self.position.get_ref().0);
        let w = self.w.as_ref().map_or(1.0, |w| *w.get_ref());
        light(position, w).map_err(|error| match (error, &self.w) {
            (LightError::Weight(_), Some(w)) => misplaced(w, &error),
            _ => misplaced(&self.position, &error),
        })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraWire {
    fov_deg: Spanned<f64>,
    near: Spanned<f32>,
    #[serde(default)]
    up: Option<Spanned<Exactly<f32, 3>>>,
    keys: Spanned<Vec<Spanned<KeyWire>>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KeyWire {
    time_s: f64,
    eye: Exactly<f32, 3>,
    target: Exactly<f32, 3>,
}

impl CameraWire {
    fn check(self) -> Result<CameraPath, Misplaced> {
        let key = |key: &Spanned<KeyWire>| {
            let &KeyWire {
                time_s,
                eye,
                target,
            } = key.get_ref();
            CameraKey {
                time_s,
                eye: Vec3::from_array(eye.0),
                target: Vec3::from_array(target.0),
            }
        };
        let path = CameraPath {
            keys: self.keys.get_ref().iter().map(key).collect(),
            up: self
                .up
                .as_ref()
                .map_or(Vec3::Y, |up| Vec3::from_array(up.get_ref().0)),
            fov_y_rad: radians(*self.fov_deg.get_ref()),
            near: *self.near.get_ref(),
        };
        path.validate().map_err(|error| {
            let at_key = error.key.and_then(|key| self.keys.get_ref().get(key));
            let span = match (error.problem, at_key) {
                (CameraError::FieldOfView, _) => self.fov_deg.span(),
                (CameraError::Near, _) => self.near.span(),
                (_, Some(key)) => key.span(),
                (_, None) => self.keys.span(),
            };
            Misplaced {
                span,
                message: error.to_string(),
            }
        })?;
        Ok(path)
    }
}
