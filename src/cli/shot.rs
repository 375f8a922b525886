//! What is drawn and from where: arguments that several commands share, and words for what is wrong in it.

use super::values;
use crate::config::{ConfigError, find_scene};
use crate::metrics::MaskError;
use crate::scene::file::MeshSource;
use crate::scene::view::radians;
use crate::scene::{Light, Moment, Scene, Up, View};
use glam::Vec3;
use std::path::{Path, PathBuf};

/// A scene, a view of it and its light.
#[derive(Debug, clap::Args)]
pub(super) struct ShotArgs {
    /// A scene: its TOML file, the name of one that comes with the program, or an OBJ file
    scene: PathBuf,
    /// Position of the camera instead of the scene's
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vec3, allow_hyphen_values = true)]
    eye: Option<Vec3>,
    /// Point in the middle of the picture
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vec3, allow_hyphen_values = true)]
    target: Option<Vec3>,
    /// Which way is up
    #[arg(long, value_name = "X,Y,Z", value_parser = values::vec3, allow_hyphen_values = true)]
    up: Option<Vec3>,
    /// Vertical field of view in degrees
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    fov: Option<f64>,
    /// Distance of the near plane
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    near: Option<f32>,
    /// Time on the scene's flight, instead of a camera
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    #[arg(conflicts_with_all = ["eye", "target"])]
    time: Option<f64>,
    /// The light instead of the scene's: a point, or with W = 0 the direction towards it
    #[arg(long, value_name = "X,Y,Z[,W]", value_parser = values::light, allow_hyphen_values = true)]
    light: Option<Light>,
}

impl ShotArgs {
    /// The files that the scene is read from.
    pub(super) fn inputs(&self) -> anyhow::Result<Vec<PathBuf>> {
        scene_files(&self.scene)
    }

    /// The scene under its light.
    pub(super) fn load(&self) -> anyhow::Result<Scene> {
        let scene = load_scene(&self.scene)?;
        Ok(match self.light {
            Some(light) => scene.with_light(light),
            None => scene,
        })
    }

    /// The moment of that scene's flight, with the camera of the arguments.
    pub(super) fn moment(&self, scene: &Scene) -> anyhow::Result<Moment> {
        let time_s = self.time.unwrap_or(0.0);
        let duration_s = scene.flight.duration_s();
        if !(0.0..=duration_s).contains(&time_s) {
            let message =
                format!("--time: the flight lasts from 0 to {duration_s} s, not to {time_s}");
            return Err(ConfigError(message).into());
        }
        let Moment { view: path, light } = scene.flight.at(time_s);
        let view = View {
            eye: self.eye.unwrap_or(path.eye),
            target: self.target.unwrap_or(path.target),
            up: self.up.unwrap_or(path.up),
            fov_y_rad: self.fov.map_or(path.fov_y_rad, radians),
            near: self.near.unwrap_or(path.near),
        };
        let moment = Moment { view, light };
        moment
            .validate()
            .map_err(|error| ConfigError(error.to_string()))?;
        Ok(moment)
    }
}

/// The files that a scene is read from.
pub(super) fn scene_files(scene: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let mut files = vec![scene.to_owned()];
    if !is_model(scene) {
        let plan = find_scene(scene, Path::new(""))?;
        if let MeshSource::Obj { file, .. } = &plan.file.mesh {
            files.extend(plan.search.find(file));
        }
    }
    Ok(files)
}

/// A scene, or a bare model as one.
pub(super) fn load_scene(scene: &Path) -> anyhow::Result<Scene> {
    if is_model(scene) {
        return Ok(Scene::from_obj(scene, Up::Y)?);
    }
    let plan = find_scene(scene, Path::new(""))?;
    Ok(plan.file.load(&plan.search)?)
}

fn is_model(scene: &Path) -> bool {
    let extension = scene.extension();
    extension.is_some_and(|extension| extension.eq_ignore_ascii_case("obj"))
}

/// A line on how many pixels are wrong.
pub(super) fn wrong_pixels(errors: &MaskError) -> String {
    format!(
        "wrong pixels: {} ({} false lit, {} false shadowed; {} artifacts), {} ambiguous\n",
        errors.wrong_px(),
        errors.false_lit,
        errors.false_shadowed,
        errors.artifact_px,
        errors.ambiguous_px,
    )
}

/// A line on the kinds of error, if any is known.
pub(super) fn kinds_of_error(counts: impl Iterator<Item = (&'static str, u64)>) -> String {
    let kinds: Vec<_> = counts.map(|(word, px)| format!("{px} {word}")).collect();
    match kinds.is_empty() {
        true => String::new(),
        false => format!("kinds of error: {}\n", kinds.join(", ")),
    }
}
