//! The mesh of a scene file.

use std::collections::HashSet;
use std::ops::Range;
use std::path::PathBuf;

use serde::Deserialize;
use toml::Spanned;

use super::{Misplaced, misplaced};
use crate::scene::file::{MeshSource, Receiver};
use crate::scene::ground::Ground;
use crate::scene::mesh::LARGEST_COORDINATE;
use crate::scene::obj::Up;
use crate::scene::sphere_grid::SphereGrid;

#[derive(Clone, Copy, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum MeshKind {
    SphereGrid,
    Obj,
}

/// The keys of both kinds: an enum of tables would lose the places of errors.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshWire {
    kind: Spanned<MeshKind>,
    rows: Option<Spanned<u32>>,
    columns: Option<Spanned<u32>>,
    slices: Option<Spanned<u32>>,
    shells: Option<Spanned<u32>>,
    file: Option<Spanned<PathBuf>>,
    up: Option<Spanned<Up>>,
    source: Option<Spanned<String>>,
    receivers: Option<Spanned<Vec<Spanned<String>>>>,
    ground: Option<Spanned<GroundWire>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GroundWire {
    height: Spanned<f32>,
    reach: Spanned<f32>,
}

impl MeshWire {
    pub(super) fn check(
        self,
        place: &dyn Fn(&Range<usize>) -> String,
    ) -> Result<MeshSource, Misplaced> {
        let Self {
            kind,
            rows,
            columns,
            slices,
            shells,
            file,
            up,
            source,
            receivers,
            ground,
        } = self;
        let needed = |key: &str| misplaced(&kind, &format!("this kind of mesh needs `{key}`"));
        match *kind.get_ref() {
            MeshKind::SphereGrid => {
                let strangers = [
                    span_of("file", &file),
                    span_of("up", &up),
                    span_of("source", &source),
                    span_of("receivers", &receivers),
                    span_of("ground", &ground),
                ];
                refuse(&strangers, "obj")?;
                let grid = SphereGrid {
                    rows: rows.ok_or_else(|| needed("rows"))?.into_inner(),
                    columns: columns.ok_or_else(|| needed("columns"))?.into_inner(),
                    slices: slices.ok_or_else(|| needed("slices"))?.into_inner(),
                    shells: shells.map_or(1, Spanned::into_inner),
                };
                grid.validate().map_err(|error| misplaced(&kind, &error))?;
                Ok(MeshSource::SphereGrid(grid))
            }
            MeshKind::Obj => {
                let strangers = [
                    span_of("rows", &rows),
                    span_of("columns", &columns),
                    span_of("slices", &slices),
                    span_of("shells", &shells),
                ];
                refuse(&strangers, "sphere_grid")?;
                Ok(MeshSource::Obj {
                    file: file.ok_or_else(|| needed("file"))?.into_inner(),
                    up: up.ok_or_else(|| needed("up"))?.into_inner(),
                    origin: source.map(Spanned::into_inner),
                    receivers: receivers.map_or(Ok(Vec::new()), |names| {
                        check_receivers(names.into_inner(), place)
                    })?,
                    ground: ground
                        .map(|ground| check_ground(ground.get_ref()))
                        .transpose()?,
                })
            }
        }
    }
}

fn check_ground(wire: &GroundWire) -> Result<Ground, Misplaced> {
    let (height, reach) = (*wire.height.get_ref(), *wire.reach.get_ref());
    if height.is_nan() || height.abs() > LARGEST_COORDINATE {
        return Err(misplaced(
            &wire.height,
            &"a ground needs a finite height, at most 2^32",
        ));
    }
    if !(reach > 0.0 && reach <= LARGEST_COORDINATE) {
        let message = "a ground reaches farther than 0, and 2^32 at most";
        return Err(misplaced(&wire.reach, &message));
    }
    Ok(Ground { height, reach })
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
