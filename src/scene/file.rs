//! Scene files: TOML that names a mesh, a light and a camera path.

use std::collections::HashSet;
use std::path::PathBuf;

use serde::Deserialize;

use super::Scene;
use super::city::City;
use super::flight::Flight;
use super::ground::Ground;
use super::mesh::Mesh;
use super::model_search::ModelSearch;
use super::obj::{self, Model, Up};
use super::scene_error::SceneError;
use super::sphere_grid::SphereGrid;
use crate::toml_error;

/// A scene as its file describes it: checked, but without its triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// What results call it: the name of the file without the extension.
    pub name: String,
    /// What people call it.
    pub title: String,
    /// Where the triangles come from.
    pub mesh: MeshSource,
    /// What the mesh has to have, if the file says so.
    pub expect: Option<Expect>,
    /// Where camera and light are in time.
    pub flight: Flight,
    /// What the camera's lengths are in.
    pub camera_unit: CameraUnit,
}

/// What lengths of a camera are in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CameraUnit {
    /// That of the mesh.
    #[default]
    World,
    /// The radius of the sphere around the box of all that casts, from whose middle places are counted: the same camera
    /// shows the whole of a scene of any size.
    Scene,
}

/// Where the triangles of a scene come from.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSource {
    /// They are computed.
    SphereGrid(SphereGrid),
    /// The same, of a city.
    City(City),
    /// They are read from an OBJ file.
    Obj {
        /// The file, looked up by a [`ModelSearch`].
        file: PathBuf,
        /// Which axis points up in it.
        up: Up,
        /// Where to get it.
        origin: Option<String>,
        /// The objects in it that only receive shadows; all others cast.
        receivers: Vec<Receiver>,
        /// What it stands on, if the file has nothing.
        ground: Option<Ground>,
    },
}

/// An object of a model that receives shadows and casts none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Receiver {
    /// Its name in the model file; every object of that name is meant.
    pub name: String,
    /// Where the scene file says so, for errors: `file:line:column`.
    pub place: String,
}

/// Counts that tell whether the mesh is the right one; receivers are not counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expect {
    /// Triangles that cast a shadow.
    pub triangles: u64,
    /// Objects that cast a shadow.
    pub objects: u64,
}

impl SceneFile {
    /// The same scene with another sphere grid: each number that is given replaces the file's.
    pub fn with_sphere_grid(
        mut self,
        rows: Option<u32>,
        columns: Option<u32>,
        slices: Option<u32>,
    ) -> Result<Self, SceneError> {
        let MeshSource::SphereGrid(grid) = &mut self.mesh else {
            return Err(SceneError::NotASphereGrid { scene: self.name });
        };
        let file_size = (grid.rows, grid.columns);
        *grid = SphereGrid {
            rows: rows.unwrap_or(grid.rows),
            columns: columns.unwrap_or(grid.columns),
            slices: slices.unwrap_or(grid.slices),
            shells: grid.shells,
        };
        let scene = &self.name;
        grid.validate().map_err(|source| SceneError::SphereGrid {
            scene: scene.clone(),
            source,
        })?;
        let SphereGrid {
            rows,
            columns,
            slices,
            shells,
        } = *grid;
        let nested = match shells {
            1 => String::new(),
            _ => format!(", {shells} shells"),
        };
        self.title = format!("Sphere grid {rows} × {columns}, {slices} slices{nested}");
        // Variants of one grid are a family: same name, ending in the number of slices.
        let grid_name = &self.name;
        self.name = if (rows, columns) == file_size {
            format!("{grid_name}_n{slices}")
        } else {
            format!("{grid_name}_{rows}x{columns}_n{slices}")
        };
        self.expect = Some(Expect {
            triangles: grid.triangle_count(),
            objects: grid.sphere_count(),
        });
        Ok(self)
    }

    /// With so many shells about each centre, before [`Self::with_sphere_grid`]; the scene is called after them.
    ///
    /// # Errors
    /// When its mesh is no sphere grid.
    pub fn with_shells(mut self, shells: u32) -> Result<Self, SceneError> {
        let MeshSource::SphereGrid(grid) = &mut self.mesh else {
            return Err(SceneError::NotASphereGrid { scene: self.name });
        };
        grid.shells = shells;
        self.name = format!("{}_d{shells}", self.name);
        Ok(self)
    }

    /// With another city: each number that is given replaces the file's, and the scene is called after it.
    ///
    /// # Errors
    /// When its mesh is no city, or there is no such city.
    pub fn with_city(
        mut self,
        objects: Option<u32>,
        tree_triangles: Option<u32>,
    ) -> Result<Self, SceneError> {
        let MeshSource::City(city) = &mut self.mesh else {
            return Err(SceneError::NotACity { scene: self.name });
        };
        if let Some(triangles) = tree_triangles {
            city.tree_triangles = triangles;
            self.name += &format!("_t{triangles}");
            self.title += &format!(", a tree of {triangles} triangles");
        }
        if let Some(objects) = objects {
            city.objects = objects;
            self.name += &format!("_o{objects}");
            self.title += &format!(", {objects} objects");
        }
        city.validate().map_err(|source| SceneError::City {
            scene: self.name.clone(),
            source,
        })?;
        self.expect = None;
        Ok(self)
    }

    /// In pictures of this size, which the scene is called after.
    pub fn at_size(mut self, (width, height): (u32, u32)) -> Self {
        self.name = format!("{}_{width}x{height}px", self.name);
        self.title = format!("{}, {width} × {height} px", self.title);
        self
    }

    /// Loads the mesh and compares it with what the file expects.
    pub fn load(&self, search: &ModelSearch) -> Result<Scene, SceneError> {
        let Model { mesh, notes } = self.load_model(search)?;
        let triangles = mesh.caster_triangle_count() as u64;
        let objects = mesh.caster_object_count() as u64;
        if let Some(expect) = self.expect.filter(|e| *e != Expect { triangles, objects }) {
            return Err(SceneError::Unexpected {
                scene: self.name.clone(),
                expected_triangles: expect.triangles,
                expected_objects: expect.objects,
                triangles,
                objects,
            });
        }
        let (name, title) = (self.name.clone(), self.title.clone());
        let mut flight = self.flight.clone();
        if self.camera_unit == CameraUnit::Scene {
            let (low, high) = mesh.caster_bounds();
            flight.camera = flight.camera.around(low, high);
        }
        Ok(Scene {
            notes,
            ..Scene::new(name, title, mesh, flight)
        })
    }

    fn load_model(&self, search: &ModelSearch) -> Result<Model, SceneError> {
        let scene = || self.name.clone();
        match &self.mesh {
            MeshSource::SphereGrid(grid) => match grid.mesh() {
                Ok(mesh) => Ok(Model {
                    mesh,
                    notes: Vec::new(),
                }),
                Err(source) => Err(SceneError::SphereGrid {
                    scene: scene(),
                    source,
                }),
            },
            MeshSource::City(city) => match city.mesh() {
                Ok(mesh) => Ok(Model {
                    mesh,
                    notes: Vec::new(),
                }),
                Err(source) => Err(SceneError::City {
                    scene: scene(),
                    source,
                }),
            },
            MeshSource::Obj {
                file,
                up,
                origin,
                receivers,
                ground,
            } => {
                let path = search.find(file).ok_or_else(|| SceneError::MissingModel {
                    file: file.clone(),
                    searched: search.candidates(file),
                    origin: origin.clone(),
                })?;
                let mut model = obj::load(&path, *up).map_err(|source| SceneError::Model {
                    scene: scene(),
                    source,
                })?;
                mark_receivers(receivers, &mut model.mesh)?;
                if let Some(ground) = ground {
                    let ground = ground.part(&model.mesh);
                    model.mesh.push(&ground);
                }
                Ok(model)
            }
        }
    }
}

/// Makes receivers of the objects of these names.
fn mark_receivers(receivers: &[Receiver], mesh: &mut Mesh) -> Result<(), SceneError> {
    let names = || mesh.objects.iter().map(|object| object.name.as_str());
    let known: HashSet<&str> = names().collect();
    let unknown = |receiver: &&Receiver| !known.contains(receiver.name.as_str());
    if let Some(Receiver { name, place }) = receivers.iter().find(unknown) {
        return Err(SceneError::UnknownReceiver {
            place: place.clone(),
            name: name.clone(),
            nearest: toml_error::nearest(name, names()).map(str::to_owned),
        });
    }
    let meant: HashSet<&str> = receivers.iter().map(|r| r.name.as_str()).collect();
    for object in &mut mesh.objects {
        object.casts_shadow &= !meant.contains(object.name.as_str());
    }
    Ok(())
}

#[cfg(test)]
#[path = "file_tests.rs"]
mod tests;
