//! The mesh of a scene file.

use std::collections::HashSet;
use std::ops::Range;
use std::path::PathBuf;

use serde::Deserialize;
use toml::Spanned;

use super::{Misplaced, misplaced};
use crate::scene::city::City;
use crate::scene::file::{MeshSource, Receiver};
use crate::scene::ground::Ground;
use crate::scene::mesh::LARGEST_COORDINATE;
use crate::scene::obj::Up;
use crate::scene::sphere_grid::SphereGrid;

#[derive(Clone, Copy, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum MeshKind {
    SphereGrid,
    City,
    Obj,
}

/// The keys of all kinds: an enum of tables would lose the places of errors.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshWire {
    kind: Spanned<MeshKind>,
    rows: Option<Spanned<u32>>,
    columns: Option<Spanned<u32>>,
    slices: Option<Spanned<u32>>,
    shells: Option<Spanned<u32>>,
    objects: Option<Spanned<u32>>,
    seed: Option<Spanned<u64>>,
    ledges: Option<Spanned<u32>>,
    tree_triangles: Option<Spanned<u32>>,
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
        self.refuse_strangers()?;
        match *self.kind.get_ref() {
            MeshKind::SphereGrid => {
                let grid = SphereGrid {
                    rows: self.needed("rows", &self.rows)?,
                    columns: self.needed("columns", &self.columns)?,
                    slices: self.needed("slices", &self.slices)?,
                    shells: value_or(&self.shells, 1),
                };
                grid.validate()
                    .map_err(|error| misplaced(&self.kind, &error))?;
                Ok(MeshSource::SphereGrid(grid))
            }
            MeshKind::City => {
                let city = City {
                    objects: self.needed("objects", &self.objects)?,
                    seed: value_or(&self.seed, 0),
                    ledges: value_or(&self.ledges, 0),
                    tree_triangles: value_or(&self.tree_triangles, 0),
                };
                city.validate()
                    .map_err(|error| misplaced(&self.kind, &error))?;
                Ok(MeshSource::City(city))
            }
            MeshKind::Obj => Ok(MeshSource::Obj {
                file: self.needed("file", &self.file)?,
                up: self.needed("up", &self.up)?,
                origin: self.source.map(Spanned::into_inner),
                receivers: self.receivers.map_or(Ok(Vec::new()), |names| {
                    check_receivers(names.into_inner(), place)
                })?,
                ground: self
                    .ground
                    .map(|ground| check_ground(ground.get_ref()))
                    .transpose()?,
            }),
        }
    }

    fn needed<T: Clone>(&self, key: &str, value: &Option<Spanned<T>>) -> Result<T, Misplaced> {
        let value = value.as_ref().map(|value| value.get_ref().clone());
        value.ok_or_else(|| {
            let message = format!("this kind of mesh needs `{key}`");
            misplaced(&self.kind, &message)
        })
    }

    /// Keys of other kinds.
    fn refuse_strangers(&self) -> Result<(), Misplaced> {
        let of_kinds = [
            (
                MeshKind::SphereGrid,
                "sphere_grid",
                vec![
                    span_of("rows", &self.rows),
                    span_of("columns", &self.columns),
                    span_of("slices", &self.slices),
                    span_of("shells", &self.shells),
                ],
            ),
            (
                MeshKind::City,
                "city",
                vec![
                    span_of("objects", &self.objects),
                    span_of("seed", &self.seed),
                    span_of("ledges", &self.ledges),
                    span_of("tree_triangles", &self.tree_triangles),
                ],
            ),
            (
                MeshKind::Obj,
                "obj",
                vec![
                    span_of("file", &self.file),
                    span_of("up", &self.up),
                    span_of("source", &self.source),
                    span_of("receivers", &self.receivers),
                    span_of("ground", &self.ground),
                ],
            ),
        ];
        let strangers = of_kinds
            .iter()
            .filter(|(kind, ..)| kind != self.kind.get_ref());
        for (_, kind, keys) in strangers {
            refuse(keys, kind)?;
        }
        Ok(())
    }
}

fn value_or<T: Copy>(value: &Option<Spanned<T>>, otherwise: T) -> T {
    value.as_ref().map_or(otherwise, |value| *value.get_ref())
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
