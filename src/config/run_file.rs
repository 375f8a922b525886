//! The run configuration's TOML.

use super::{ConfigError, RunPlan, ScenePlan, find_scene, scene_lookup};
use crate::methods::{self, ShadowMethod, parameters};
use crate::scene::{SceneError, SphereGridError};
use crate::toml_array::Exactly;
use crate::toml_error;
use serde::Deserialize;
use std::io::ErrorKind;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, Deserializer};

/// Largest number of frames or rounds; more is a slip of the finger.
const MOST_FRAMES: u32 = 1_000_000;
/// Largest picture side that any device can draw.
const MOST_PIXELS: u32 = 1 << 16;

/// All keys but `methods`, whose tables belong to the methods.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wire {
    title: String,
    #[serde(default = "default_size")]
    size: Spanned<Exactly<u32, 2>>,
    #[serde(default = "default_frames")]
    frames: Spanned<u32>,
    #[serde(default = "default_warmup")]
    warmup_frames: Spanned<u32>,
    #[serde(default = "default_verified")]
    verified_frames: Spanned<u32>,
    #[serde(default)]
    seed: u64,
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

fn default_verified() -> Spanned<u32> {
    Spanned::new(0..0, 2)
}

/// A complaint about a part of the text.
struct Misplaced {
    span: Option<Range<usize>>,
    message: String,
}

impl Misplaced {
    fn new(span: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            span: Some(span),
            message: message.into(),
        }
    }
}

impl From<toml::de::Error> for Misplaced {
    fn from(error: toml::de::Error) -> Self {
        Self {
            span: error.span(),
            message: toml_error::with_suggestion(error.message()),
        }
    }
}

impl RunPlan {
    /// Reads and checks a configuration file, and the scene files that it names.
    ///
    /// # Errors
    /// What is wrong, with file, line and column.
    pub fn read(path: &Path) -> Result<Self, ConfigError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| {
            let hint = match error.kind() {
                _ if path.is_dir() => "; name a TOML file in it",
                ErrorKind::NotFound => "; check the path",
                ErrorKind::InvalidData => "; save it as UTF-8 text",
                _ => "",
            };
            ConfigError(format!("{name}: cannot be read: {error}{hint}"))
        })?;
        let base = path.parent().unwrap_or(Path::new(""));
        Self::parse(&text, &name, base)
    }

    /// Checks the text of a configuration; `base` is the folder that scene paths start from.
    ///
    /// # Errors
    /// What is wrong, with file, line and column.
    pub fn parse(text: &str, name: &str, base: &Path) -> Result<Self, ConfigError> {
        let plan = parse(text, base).map_err(|Misplaced { span, message }| match span {
            Some(span) => ConfigError(toml_error::at(&span, &message, text, name)),
            None => ConfigError(format!("{name}: {message}")),
        })?;
        Ok(Self {
            path: name.to_owned(),
            text: text.to_owned(),
            ..plan
        })
    }
}

fn parse(text: &str, base: &Path) -> Result<RunPlan, Misplaced> {
    let mut document = DeTable::parse(text)?;
    let methods = read_methods(document.get_mut().remove("methods"))?;
    let wire = Wire::deserialize(Deserializer::from(document))?;
    if wire.scenes.is_empty() {
        return Err(missing("scenes", "scene = \"sphere_grid\""));
    }
    let in_range = |what: &Spanned<u32>, name: &str, least: u32, most: u32| {
        let value = *what.get_ref();
        if (least..=most).contains(&value) {
            return Ok(value);
        }
        let message = format!("`{name}` is {value}; it must be from {least} to {most}");
        Err(Misplaced::new(what.span(), message))
    };
    let Exactly([width, height]) = *wire.size.get_ref();
    if let Err(message) = check_size((width, height)) {
        return Err(Misplaced::new(wire.size.span(), message));
    }
    Ok(RunPlan {
        title: wire.title,
        size_px: (width, height),
        frames: in_range(&wire.frames, "frames", 1, MOST_FRAMES)?,
        warmup_frames: in_range(&wire.warmup_frames, "warmup_frames", 0, MOST_FRAMES)?,
        verified_frames: in_range(&wire.verified_frames, "verified_frames", 0, MOST_FRAMES)?,
        seed: wire.seed,
        scenes: read_scenes(&wire.scenes, base)?,
        methods,
        path: String::new(),
        text: String::new(),
        scale: String::new(),
    })
}

fn missing(key: &str, example: &str) -> Misplaced {
    let message = format!("no `[[{key}]]`: name at least one, for example `{example}`");
    Misplaced {
        span: None,
        message,
    }
}

fn read_scenes(wires: &[SceneWire], base: &Path) -> Result<Vec<ScenePlan>, Misplaced> {
    let mut scenes: Vec<ScenePlan> = Vec::new();
    for wire in wires {
        let scene = read_scene(wire, base)?;
        let name = &scene.file.name;
        if scenes.iter().any(|earlier| earlier.file.name == *name) {
            return Err(twice(wire.scene.span(), "scene", name));
        }
        scenes.push(scene);
    }
    Ok(scenes)
}

/// Results tell cells apart by scene, method and variant.
fn twice(span: Range<usize>, what: &str, name: &str) -> Misplaced {
    let message = format!("the {what} `{name}` is there already; remove one of the two");
    Misplaced::new(span, message)
}

fn read_scene(wire: &SceneWire, base: &Path) -> Result<ScenePlan, Misplaced> {
    let misplaced = |message: String| Misplaced::new(wire.scene.span(), message);
    let ScenePlan { mut file, search } =
        find_scene(wire.scene.get_ref(), base).map_err(|error| misplaced(error.0))?;
    let slices = wire.slices.as_ref();
    if wire.rows.is_some() || wire.columns.is_some() || slices.is_some() {
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
    Ok(ScenePlan { file, search })
}

fn read_methods(
    value: Option<Spanned<DeValue<'_>>>,
) -> Result<Vec<Box<dyn ShadowMethod>>, Misplaced> {
    let example = "id = \"silhouette_ts\"";
    let value = value.ok_or_else(|| missing("methods", example))?;
    let span = value.span();
    match value.into_inner() {
        DeValue::Array(array) if array.is_empty() => Err(missing("methods", example)),
        DeValue::Array(array) => read_distinct_methods(array),
        _ => Err(Misplaced::new(
            span,
            "`methods` must be tables: `[[methods]]`",
        )),
    }
}

fn read_distinct_methods(array: DeArray<'_>) -> Result<Vec<Box<dyn ShadowMethod>>, Misplaced> {
    let label = |method: &dyn ShadowMethod| {
        let label = format!("{} {}", method.info().id, method.variant());
        label.trim_end().to_owned()
    };
    let mut methods: Vec<Box<dyn ShadowMethod>> = Vec::new();
    for entry in array {
        let span = entry.span();
        let method = read_method(entry)?;
        let name = label(method.as_ref());
        if methods
            .iter()
            .any(|earlier| label(earlier.as_ref()) == name)
        {
            return Err(twice(span, "method", &name));
        }
        methods.push(method);
    }
    Ok(methods)
}

fn read_method(entry: Spanned<DeValue<'_>>) -> Result<Box<dyn ShadowMethod>, Misplaced> {
    let span = entry.span();
    let DeValue::Table(mut table) = entry.into_inner() else {
        return Err(Misplaced::new(
            span,
            "a method must be a table with an `id`",
        ));
    };
    let id = table
        .remove("id")
        .ok_or_else(|| Misplaced::new(span.clone(), "this method has no `id`"))?;
    let Some(name) = id.get_ref().as_str() else {
        return Err(Misplaced::new(id.span(), "`id` must be a string"));
    };
    let registration = methods::find(name)
        .ok_or_else(|| Misplaced::new(id.span(), parameters::unknown_method(name)))?;
    (registration.configure)(Spanned::new(span.clone(), DeValue::Table(table))).map_err(|error| {
        let message = toml_error::with_suggestion(&error.message);
        Misplaced::new(
            error.span.unwrap_or(span),
            format!("method `{name}`: {message}"),
        )
    })
}

fn check_size((width, height): (u32, u32)) -> Result<(), String> {
    let side = 1..=MOST_PIXELS;
    if side.contains(&width) && side.contains(&height) {
        return Ok(());
    }
    Err(format!(
        "a picture of {width} × {height} pixels; both sides must be 1 to {MOST_PIXELS}"
    ))
}

/// Checks the numbers that the command line may have changed.
pub(super) fn check_counts(plan: &RunPlan) -> Result<(), String> {
    check_size(plan.size_px)?;
    if !(1..=MOST_FRAMES).contains(&plan.frames) {
        return Err(format!(
            "{} frames; it must be 1 to {MOST_FRAMES}",
            plan.frames
        ));
    }
    Ok(())
}
