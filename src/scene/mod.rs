//! What is drawn: a mesh, a light and a camera path, from a scene file or a model file.

pub mod camera;
pub mod export;
pub mod file;
pub mod light;
pub mod mesh;
pub mod model_search;
pub mod obj;
mod obj_checks;
mod obj_notes;
mod obj_problem;
mod obj_text;
pub mod part;
mod polygon;
pub mod scene_error;
pub mod sphere_grid;
pub mod view;
mod weld;
mod wire;

use std::path::Path;

use glam::{Vec3, Vec4};

pub use camera::{CameraKey, CameraPath};
pub use export::ExportError;
pub use file::SceneFile;
pub use light::LightError;
pub use mesh::{Mesh, Object};
pub use model_search::ModelSearch;
pub use obj::{Model, ObjError, Up};
pub use part::Part;
pub use scene_error::SceneError;
pub use sphere_grid::{SphereGrid, SphereGridError};
pub use view::View;

/// All that a frame needs to know about the world: plain data.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// What results call it: the name of its file without the extension.
    pub name: String,
    /// What people call it.
    pub title: String,
    /// Its triangles.
    pub mesh: Mesh,
    /// The light, canonical: a position with w = 1, or with w = 0 the direction *towards* it, whose largest
    /// coordinate is 1. One too far away to tell from a direction is one.
    pub light: Vec4,
    /// Where the pictures are taken from.
    pub camera: CameraPath,
    /// Hexadecimal BLAKE3 of the mesh: equal hashes mean equal work.
    pub mesh_hash: String,
    /// What to know about the model before trusting a picture of it.
    pub notes: Vec<String>,
}

impl Scene {
    /// Puts a scene together and hashes its mesh.
    pub fn new(name: String, title: String, mesh: Mesh, light: Vec4, camera: CameraPath) -> Self {
        let mesh_hash = mesh.hash();
        let light = light::of_scene(light, &mesh);
        Self {
            name,
            title,
            mesh,
            light,
            camera,
            mesh_hash,
            notes: Vec::new(),
        }
    }

    /// The same scene under another light.
    pub fn with_light(self, light: Vec4) -> Self {
        let light = light::of_scene(light, &self.mesh);
        Self { light, ..self }
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
        let light = light.extend(1.0);
        Ok(Self {
            notes,
            ..Self::new(name.clone(), name, mesh, light, camera)
        })
    }
}
