//! The run configuration's TOML.

use super::method_tables::read_methods;
use super::misplaced::{Misplaced, missing};
use super::{
    ConfigError, RunPlan, ScenePlan, Verification, VerifiedFrames, find_scene, scene_lookup,
};
use crate::methods::Registry;
use crate::scene::{SceneError, SphereGridError};
use crate::toml_array::Exactly;
use crate::toml_error;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;
use std::time::Duration;
use toml::Spanned;
use toml::de::{DeTable, Deserializer};

/// Largest number of frames or rounds; more is a slip of the finger.
const MAX_FRAMES: u32 = 1_000_000;
/// Most frames that lead in to one: ten seconds.
const MAX_LEAD_IN: u32 = 600;
/// Most seconds that a cell may be given: a week.
const MAX_TIMEOUT_S: f64 = 604_800.0;
/// Largest picture side that any device can draw.
const MAX_PIXELS: u32 = 1 << 16;

/// All keys but `methods`, whose tables belong to the methods.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RunWire {
    title: String,
    #[serde(default = "default_size")]
    size: Spanned<Exactly<u32, 2>>,
    #[serde(default = "default_frames")]
    frames: Spanned<u32>,
    #[serde(default = "default_warmup")]
    warmup_frames: Spanned<u32>,
    #[serde(default = "default_lead_in")]
    lead_in: Spanned<u32>,
    #[serde(default = "default_cell_timeout")]
    cell_timeout_s: Spanned<f64>,
    verified_frames: Option<Spanned<u32>>,
    verify_every: Option<Spanned<u32>>,
    #[serde(default)]
    flicker: bool,
    #[serde(default)]
    flip: bool,
    #[serde(default)]
    seed: u64,
    #[serde(default)]
    scales: BTreeMap<String, ScaleWire>,
    #[serde(default)]
    scenes: Vec<SceneWire>,
    /// Never read: taken out before. Here so that messages about unknown keys name it.
    #[serde(default, rename = "methods")]
    _methods: Vec<serde::de::IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneWire {
    scene: Spanned<String>,
    rows: Option<u32>,
    columns: Option<u32>,
    slices: Option<Spanned<u32>>,
    shells: Option<u32>,
    objects: Option<u32>,
    tree_triangles: Option<u32>,
    size: Option<Spanned<Exactly<u32, 2>>>,
    scales: Option<Vec<Spanned<String>>>,
}

/// What a smaller scale of the same run replaces.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScaleWire {
    size: Option<Spanned<Exactly<u32, 2>>>,
    frames: Option<Spanned<u32>>,
    warmup_frames: Option<Spanned<u32>>,
    verified_frames: Option<Spanned<u32>>,
    verify_every: Option<Spanned<u32>>,
}

/// The scale that a configuration's own numbers are.
const FULL_SCALE: &str = "full";

impl RunWire {
    /// Replaces what the scale `name` replaces, and leaves out the scenes that are not of it.
    fn scale_to(&mut self, name: &str) -> Result<(), String> {
        if let Some(scale) = self.scales.remove(name) {
            self.size = scale.size.unwrap_or(self.size.clone());
            self.frames = scale.frames.unwrap_or(self.frames.clone());
            self.warmup_frames = scale.warmup_frames.unwrap_or(self.warmup_frames.clone());
            if scale.verified_frames.is_some() || scale.verify_every.is_some() {
                self.verified_frames = scale.verified_frames;
                self.verify_every = scale.verify_every;
            }
        } else if name != FULL_SCALE {
            let known: Vec<_> = self.scales.keys().map(String::as_str).collect();
            let all = [&known[..], &[FULL_SCALE]].concat();
            let hint = toml_error::nearest(name, all.iter().copied())
                .map(|nearest| format!("; did you mean `{nearest}`?"))
                .unwrap_or_default();
            return Err(format!(
                "no scale `{name}`{hint} (this configuration has {})",
                all.join(", ")
            ));
        }
        self.scenes.retain(|scene| match &scene.scales {
            None => true,
            Some(scales) => scales.iter().any(|scale| scale.get_ref() == name),
        });
        if self.scenes.is_empty() {
            return Err(format!("no scene is of the scale `{name}`"));
        }
        Ok(())
    }

    /// A scale that a scene names and the configuration does not have.
    fn unknown_scale(&self) -> Option<&Spanned<String>> {
        let named = self
            .scenes
            .iter()
            .flat_map(|scene| scene.scales.iter().flatten());
        let is_known = |name: &str| name == FULL_SCALE || self.scales.contains_key(name);
        named.into_iter().find(|name| !is_known(name.get_ref()))
    }
}

fn default_size() -> Spanned<Exactly<u32, 2>> {
    Spanned::new(0..0, Exactly([1024, 768]))
}

fn default_frames() -> Spanned<u32> {
    Spanned::new(0..0, 32)
}

fn default_warmup() -> Spanned<u32> {
    Spanned::new(0..0, 2)
}

fn default_lead_in() -> Spanned<u32> {
    Spanned::new(0..0, 0)
}

fn default_cell_timeout() -> Spanned<f64> {
    Spanned::new(0..0, 3600.0)
}

/// Default number of frames compared with the truth.
const VERIFIED_FRAMES: u32 = 2;

impl RunPlan {
    /// Reads and checks a configuration file at one of its scales, and the scene files that it names; its methods are
    /// those of `registry`.
    ///
    /// # Errors
    /// What is wrong, with file, line and column.
    pub fn read(path: &Path, scale: &str, registry: &Registry) -> Result<Self, ConfigError> {
        let text = read_text(path)?;
        let name = path.display().to_string();
        let base = path.parent().unwrap_or(Path::new(""));
        Self::parse(&text, &name, base, scale, registry)
    }

    /// Checks the text of a configuration; `base` is the folder that scene paths start from.
    ///
    /// # Errors
    /// What is wrong, with file, line and column.
    pub fn parse(
        text: &str,
        name: &str,
        base: &Path,
        scale: &str,
        registry: &Registry,
    ) -> Result<Self, ConfigError> {
        let plan =
            parse(text, base, scale, registry).map_err(
                |Misplaced { span, message }| match span {
                    Some(span) => ConfigError(toml_error::at(&span, &message, text, name)),
                    None => ConfigError(format!("{name}: {message}")),
                },
            )?;
        Ok(Self {
            path: name.to_owned(),
            text: text.to_owned(),
            ..plan
        })
    }
}

/// The text of a configuration file.
pub(crate) fn read_text(path: &Path) -> Result<String, ConfigError> {
    std::fs::read_to_string(path).map_err(|error| {
        let hint = match error.kind() {
            _ if path.is_dir() => "; name a TOML file in it",
            ErrorKind::NotFound => "; check the path",
            ErrorKind::InvalidData => "; save it as UTF-8 text",
            _ => "",
        };
        let name = path.display();
        ConfigError(format!("{name}: cannot be read: {error}{hint}"))
    })
}

fn parse(text: &str, base: &Path, scale: &str, registry: &Registry) -> Result<RunPlan, Misplaced> {
    let mut document = DeTable::parse(text)?;
    let methods = read_methods(document.get_mut().remove("methods"), registry)?;
    let mut wire = RunWire::deserialize(Deserializer::from(document))?;
    if wire.scenes.is_empty() {
        return Err(missing("scenes", "scene = \"sphere_grid\""));
    }
    if wire.scales.contains_key(FULL_SCALE) {
        let message =
            "`[scales.full]`: `full` is the configuration's own numbers; rename the scale";
        return Err(Misplaced {
            span: None,
            message: message.to_owned(),
        });
    }
    if let Some(name) = wire.unknown_scale() {
        let message = format!("no `[scales.{}]` in this configuration", name.get_ref());
        return Err(Misplaced::new(name.span(), message));
    }
    wire.scale_to(scale).map_err(|message| Misplaced {
        span: None,
        message: format!("--scale: {message}"),
    })?;
    let size_px = picture_size(&wire.size)?;
    let verified_frames = verified_frames(&wire)?;
    Ok(RunPlan {
        title: wire.title,
        size_px,
        frames: in_range(&wire.frames, "frames", 1, MAX_FRAMES)?,
        warmup_frames: in_range(&wire.warmup_frames, "warmup_frames", 0, MAX_FRAMES)?,
        lead_in: in_range(&wire.lead_in, "lead_in", 0, MAX_LEAD_IN)?,
        cell_timeout: cell_timeout(&wire.cell_timeout_s)?,
        verification: Verification {
            frames: verified_frames,
            flicker: wire.flicker,
            flip: wire.flip,
        },
        seed: wire.seed,
        scenes: read_scenes(&wire.scenes, base)?,
        methods,
        path: String::new(),
        text: String::new(),
        scale: scale.to_owned(),
    })
}

fn in_range(what: &Spanned<u32>, name: &str, least: u32, most: u32) -> Result<u32, Misplaced> {
    let value = *what.get_ref();
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    let message = format!("`{name}` is {value}; it must be from {least} to {most}");
    Err(Misplaced::new(what.span(), message))
}

/// The time that a cell has; 0 for no limit.
fn cell_timeout(seconds: &Spanned<f64>) -> Result<Option<Duration>, Misplaced> {
    let value = *seconds.get_ref();
    if (0.0..=MAX_TIMEOUT_S).contains(&value) {
        return Ok((value > 0.0).then(|| Duration::from_secs_f64(value)));
    }
    let message =
        format!("`cell_timeout_s` is {value}; it must be from 0 (no limit) to {MAX_TIMEOUT_S}");
    Err(Misplaced::new(seconds.span(), message))
}

fn verified_frames(wire: &RunWire) -> Result<VerifiedFrames, Misplaced> {
    match (&wire.verified_frames, &wire.verify_every) {
        (Some(_), Some(every)) => Err(Misplaced::new(
            every.span(),
            "`verify_every` and `verified_frames` say the same in two ways; remove one of the two",
        )),
        (None, Some(every)) => Ok(VerifiedFrames::Every(in_range(
            every,
            "verify_every",
            1,
            MAX_FRAMES,
        )?)),
        (Some(count), None) => Ok(VerifiedFrames::Spread(in_range(
            count,
            "verified_frames",
            0,
            MAX_FRAMES,
        )?)),
        (None, None) => Ok(VerifiedFrames::Spread(VERIFIED_FRAMES)),
    }
}

fn picture_size(wire: &Spanned<Exactly<u32, 2>>) -> Result<(u32, u32), Misplaced> {
    let Exactly([width, height]) = *wire.get_ref();
    check_size((width, height)).map_err(|message| Misplaced::new(wire.span(), message))?;
    Ok((width, height))
}

fn read_scenes(wires: &[SceneWire], base: &Path) -> Result<Vec<ScenePlan>, Misplaced> {
    let mut scenes: Vec<ScenePlan> = Vec::new();
    for wire in wires {
        let scene = read_scene(wire, base)?;
        let name = &scene.file.name;
        if scenes.iter().any(|earlier| earlier.file.name == *name) {
            let message = format!(
                "the scene `{name}` is there already; results tell scenes apart by the names of their files: remove \
                 or rename one of the two"
            );
            return Err(Misplaced::new(wire.scene.span(), message));
        }
        scenes.push(scene);
    }
    Ok(scenes)
}

fn read_scene(wire: &SceneWire, base: &Path) -> Result<ScenePlan, Misplaced> {
    let misplaced = |message: String| Misplaced::new(wire.scene.span(), message);
    let ScenePlan {
        mut file, search, ..
    } = find_scene(wire.scene.get_ref(), base).map_err(|error| misplaced(error.0))?;
    let slices = wire.slices.as_ref();
    if let Some(shells) = wire.shells {
        file = file
            .with_shells(shells)
            .map_err(|error| misplaced(scene_lookup::chain(&error)))?;
    }
    let is_other_grid = wire.rows.is_some() || wire.columns.is_some() || wire.shells.is_some();
    if is_other_grid || slices.is_some() {
        file = file
            .with_sphere_grid(
                wire.rows,
                wire.columns,
                slices.map(|slices| *slices.get_ref()),
            )
            .map_err(|error| {
                let about_slices = matches!(
                    error,
                    SceneError::SphereGrid {
                        source: SphereGridError::Slices { .. },
                        ..
                    }
                );
                let span = slices.filter(|_| about_slices).map(Spanned::span);
                let span = span.unwrap_or(wire.scene.span());
                Misplaced::new(span, scene_lookup::chain(&error))
            })?;
    }
    if wire.objects.is_some() || wire.tree_triangles.is_some() {
        file = file
            .with_city(wire.objects, wire.tree_triangles)
            .map_err(|error| misplaced(scene_lookup::chain(&error)))?;
    }
    let size_px = wire.size.as_ref().map(picture_size).transpose()?;
    if let Some(size_px) = size_px {
        file = file.at_size(size_px);
    }
    Ok(ScenePlan {
        file,
        search,
        size_px,
    })
}

pub(crate) fn check_size((width, height): (u32, u32)) -> Result<(), String> {
    let side = 1..=MAX_PIXELS;
    if side.contains(&width) && side.contains(&height) {
        return Ok(());
    }
    Err(format!(
        "a picture of {width} × {height} pixels; both sides must be 1 to {MAX_PIXELS}"
    ))
}

/// Checks the numbers that the command line may have changed.
pub(super) fn check_counts(plan: &RunPlan) -> Result<(), String> {
    check_size(plan.size_px)?;
    if !(1..=MAX_FRAMES).contains(&plan.frames) {
        return Err(format!(
            "{} frames; it must be 1 to {MAX_FRAMES}",
            plan.frames
        ));
    }
    Ok(())
}
