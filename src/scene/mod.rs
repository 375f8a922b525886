//! What is drawn: a mesh, and a flight of camera and light, from a scene file or a model file.

pub mod camera;
pub mod city;
pub mod export;
pub mod file;
pub mod flight;
pub mod ground;
pub mod light;
pub mod light_keys;
pub mod light_path;
pub mod mesh;
pub mod model_search;
pub mod obj;
mod obj_checks;
mod obj_notes;
mod obj_problem;
mod obj_text;
mod other_kind;
pub mod part;
mod polygon;
pub mod scene_error;
pub mod sphere_grid;
mod spline;
pub mod sun;
pub mod view;
mod weld;
mod wire;

use std::path::Path;
use std::sync::Arc;

use glam::Vec3;

pub use camera::{CameraKey, CameraPath};
pub use city::{City, CityError};
pub use export::ExportError;
pub use file::SceneFile;
pub use flight::{Flight, FrameError, Moment, MomentError};
pub use light::{Light, LightError};
pub use light_keys::{LightKey, LightKeys};
pub use light_path::LightPath;
pub use mesh::{Mesh, Object};
pub use model_search::ModelSearch;
pub use obj::{Model, ObjError, Up};
pub use part::Part;
pub use scene_error::SceneError;
pub use sphere_grid::{SphereGrid, SphereGridError};
pub use sun::Sun;
pub use view::View;

/// All that a frame needs to know about the world: plain data.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What results call it: the name of its file without the extension.
    pub name: String,
    /// What people call it.
    pub title: String,
    /// Its triangles, shared with the methods that read them in every frame.
    pub mesh: Arc<Mesh>,
    /// Where camera and light are in time; places of the light are canonical, see [`Light::place`].
    pub flight: Flight,
    /// Hexadecimal BLAKE3 of the mesh: equal hashes mean equal work.
    pub mesh_hash: String,
    /// What to know about the model before trusting a picture of it.
    pub notes: Vec<String>,
}

impl Scene {
    /// Puts a scene together and hashes its mesh.
    pub fn new(name: String, title: String, mesh: Mesh, flight: Flight) -> Self {
        let mesh_hash = mesh.hash();
        let Flight { camera, light } = flight;
        let light = light.of_scene(&mesh);
        Self {
            name,
            title,
            mesh: Arc::new(mesh),
            flight: Flight { camera, light },
            mesh_hash,
            notes: Vec::new(),
        }
    }

    /// The same scene under another light, which stands still.
    pub fn with_light(mut self, light: Light) -> Self {
        self.flight.light = LightPath::still(light).of_scene(&self.mesh);
        self
    }

    /// A bare model, seen whole and at an angle, lit from above.
    pub fn from_obj(path: &Path, up: Up) -> Result<Self, ObjError> {
        let Model { mesh, notes } = obj::load(path, up)?;
        let (low, high) = mesh.bounds();
        let camera = CameraPath::framing(low, high);
        // Well outside, and off every axis, so that no axis-aligned wall lies in a light plane.
        let size = (high - low).length();
        let light = (low + high) / 2.0 + size * Vec3::new(0.31, 1.5, 0.23);
        let name = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let flight = Flight::under(Light::at(light.extend(1.0)), camera);
        Ok(Self {
            notes,
            ..Self::new(name.clone(), name, mesh, flight)
        })
    }
}
