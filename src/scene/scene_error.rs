//! Why there is no scene.

use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};

use super::city::CityError;
use super::obj::ObjError;
use super::sphere_grid::SphereGridError;

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The scene file could not be read.
    #[error("{}: cannot be read", path.display())]
    Read {
        /// The scene file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The scene file says something that cannot be; the text names the place.
    #[error("{0}")]
    Invalid(String),
    /// The model file is in none of the places where models are looked up.
    #[error("{}", missing_model(file, searched, origin.as_deref()))]
    MissingModel {
        /// The model file, as the scene file names it.
        file: PathBuf,
        /// Every path that was tried.
        searched: Vec<PathBuf>,
        /// Where to get it, in the words of the scene file.
        origin: Option<String>,
    },
    /// The model file is there but unusable.
    #[error("scene {scene}: the model could not be loaded")]
    Model {
        /// The scene.
        scene: String,
        /// What is wrong with the file.
        source: ObjError,
    },
    /// No object of the model has the name of a receiver.
    #[error("{}", unknown_receiver(place, name, nearest.as_deref()))]
    UnknownReceiver {
        /// Where the scene file names it.
        place: String,
        /// The name.
        name: String,
        /// The name that was probably meant.
        nearest: Option<String>,
    },
    /// Rows, columns or slices that no sphere grid can have.
    #[error("scene {scene}: no such sphere grid")]
    SphereGrid {
        /// The scene.
        scene: String,
        /// What is wrong with the numbers.
        source: SphereGridError,
    },
    /// Rows, columns or slices were asked for where there are none.
    #[error(
        "scene {scene}: rows, columns and slices can be chosen only where [mesh] kind is \
         \"sphere_grid\""
    )]
    NotASphereGrid {
        /// The scene.
        scene: String,
    },
    /// Numbers that no city can have.
    #[error("scene {scene}: no such city")]
    City {
        /// The scene.
        scene: String,
        /// What is wrong with the numbers.
        source: CityError,
    },
    /// A number of objects was asked for where there is no city.
    #[error(
        "scene {scene}: objects and tree_triangles can be chosen only where [mesh] kind is \"city\""
    )]
    NotACity {
        /// The scene.
        scene: String,
    },
    /// The mesh is not the one that the scene file describes.
    #[error(
        "scene {scene}: [expect] says {expected_triangles} triangles in {expected_objects} objects, \
         but the mesh has {triangles} in {objects}; get the right model file, or correct [expect]"
    )]
    Unexpected {
        /// The scene.
        scene: String,
        /// Triangles that should cast a shadow.
        expected_triangles: u64,
        /// Objects that should.
        expected_objects: u64,
        /// Triangles that do.
        triangles: u64,
        /// Objects that do.
        objects: u64,
    },
}

fn unknown_receiver(place: &str, name: &str, nearest: Option<&str>) -> String {
    let hint = nearest.map_or(String::new(), |nearest| {
        format!("; did you mean `{nearest}`?")
    });
    format!("{place}: the model has no object `{name}`{hint}")
}

fn missing_model(file: &Path, searched: &[PathBuf], origin: Option<&str>) -> String {
    let mut text = format!("model {} not found; looked for", file.display());
    for path in searched {
        // Writing to a String does not fail.
        let _ = write!(text, "\n  {}", path.display());
    }
    if let Some(origin) = origin {
        let _ = write!(text, "\nwhere to get it: {origin}");
    }
    text + "\nput it there, or name its folder in the environment variable SVBENCH_MODELS"
}
