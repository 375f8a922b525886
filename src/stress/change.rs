//! Changes of a scene that do not change its shadow.
//!
//! A shadow depends on which points of space are covered by triangles, not on how the triangles are told:
//! in which order, in which objects, wound which way, cut how. A method whose picture changes with the
//! telling is wrong in one of the two pictures, and no truth is needed to see that: *metamorphic testing*
//! (Chen, Cheung, Yiu 1998).

use crate::geometry::Topology;
use crate::scene::{CameraKey, CameraPath, Mesh, Object, Part, Scene};
use glam::Vec3;
use rand::seq::SliceRandom;
use rand::{Rng, RngExt};
use std::collections::HashSet;

/// A change of a scene that does not change its shadow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// None: the same frame is drawn twice.
    Again,
    /// The triangles of each object in another order.
    ReorderTriangles,
    /// The vertices of each object in another order.
    RenumberVertices,
    /// Each triangle begins with another of its vertices; its winding stays.
    RotateVertices,
    /// Half of the triangles are wound the other way: both sides of each block the light.
    FlipTriangles,
    /// Closed objects are turned inside out.
    FlipClosedObjects,
    /// Each object becomes two, which share the triangles at random and no vertices.
    SplitObjects,
    /// All objects that cast become one, and all that only receive; vertices at one place become one.
    MergeObjects,
    /// The objects in another order.
    ReorderObjects,
    /// Everything is larger, by a power of two: no number is rounded otherwise.
    Scale,
    /// Each triangle is cut in four at the middles of its edges.
    Subdivide,
}

/// What a change leaves as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keeps {
    /// Every pixel of the mask.
    EveryPixel,
    /// The mask but for pixels at the true shadow boundary, since rounding moves the geometry.
    AllButBoundary,
}

/// A scene told otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Changed {
    /// The scene.
    pub scene: Scene,
    /// Of each triangle, the one of the scene before that it is, or is a part of.
    pub origins: Vec<u32>,
}

/// A mesh, and of each triangle the one that it comes from.
type Retold = (Mesh, Vec<u32>);

impl Change {
    /// All changes.
    pub const ALL: [Self; 11] = [
        Self::Again,
        Self::ReorderTriangles,
        Self::RenumberVertices,
        Self::RotateVertices,
        Self::FlipTriangles,
        Self::FlipClosedObjects,
        Self::SplitObjects,
        Self::MergeObjects,
        Self::ReorderObjects,
        Self::Scale,
        Self::Subdivide,
    ];

    /// Its name in tables.
    pub fn id(self) -> &'static str {
        match self {
            Self::Again => "again",
            Self::ReorderTriangles => "reorder_triangles",
            Self::RenumberVertices => "renumber_vertices",
            Self::RotateVertices => "rotate_vertices",
            Self::FlipTriangles => "flip_triangles",
            Self::FlipClosedObjects => "flip_closed_objects",
            Self::SplitObjects => "split_objects",
            Self::MergeObjects => "merge_objects",
            Self::ReorderObjects => "reorder_objects",
            Self::Scale => "scale",
            Self::Subdivide => "subdivide",
        }
    }

    /// One line for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::Again => "the same frame again",
            Self::ReorderTriangles => "triangles of each object in another order",
            Self::RenumberVertices => "vertices of each object in another order",
            Self::RotateVertices => "triangles that begin with another vertex",
            Self::FlipTriangles => "half of the triangles wound the other way",
            Self::FlipClosedObjects => "closed objects turned inside out",
            Self::SplitObjects => "each object split in two",
            Self::MergeObjects => "all objects in one",
            Self::ReorderObjects => "objects in another order",
            Self::Scale => "everything larger by a power of two",
            Self::Subdivide => "each triangle cut in four",
        }
    }

    /// What it leaves as it is.
    pub fn keeps(self) -> Keeps {
        match self {
            Self::Subdivide => Keeps::AllButBoundary,
            _ => Keeps::EveryPixel,
        }
    }

    /// The scene after the change. `None` where it does not apply: no object is closed, there is but one
    /// object, there is nothing to split.
    pub fn apply(self, scene: &Scene, random: &mut impl Rng) -> Option<Changed> {
        let mesh = &scene.mesh;
        let (mesh, origins) = match self {
            Self::Again => (mesh.clone(), identity(mesh.triangles.len())),
            Self::ReorderTriangles => reorder_triangles(mesh, random),
            Self::RenumberVertices => renumber_vertices(mesh, random),
            Self::RotateVertices => {
                each_triangle(mesh, |_, t| t.rotate_left(random.random_range(0..3)))
            }
            Self::FlipTriangles => each_triangle(mesh, |_, t| {
                if random.random_bool(0.5) {
                    t.swap(1, 2);
                }
            }),
            Self::FlipClosedObjects => flip_closed_objects(mesh)?,
            Self::SplitObjects => split_objects(mesh, random)?,
            Self::MergeObjects => merge_objects(mesh)?,
            Self::ReorderObjects => reorder_objects(mesh, random)?,
            Self::Scale => return scale(scene, random),
            Self::Subdivide => subdivide(mesh),
        };
        let mut changed = scene.clone();
        changed.mesh_hash = mesh.hash();
        changed.mesh = mesh;
        Some(Changed {
            scene: changed,
            origins,
        })
    }
}

fn identity(count: usize) -> Vec<u32> {
    (0..count as u32).collect()
}

/// The same mesh with each triangle changed in place.
fn each_triangle(mesh: &Mesh, mut change: impl FnMut(usize, &mut [u32; 3])) -> Retold {
    let mut changed = mesh.clone();
    let triangles = changed.triangles.iter_mut().enumerate();
    triangles.for_each(|(i, triangle)| change(i, triangle));
    (changed, identity(mesh.triangles.len()))
}

fn reorder_triangles(mesh: &Mesh, random: &mut impl Rng) -> Retold {
    let mut origins = identity(mesh.triangles.len());
    for object in &mesh.objects {
        origins[object.triangle_range()].shuffle(random);
    }
    let triangles = origins.iter().map(|t| mesh.triangles[*t as usize]);
    let changed = Mesh {
        triangles: triangles.collect(),
        ..mesh.clone()
    };
    (changed, origins)
}

fn renumber_vertices(mesh: &Mesh, random: &mut impl Rng) -> Retold {
    let mut numbers = identity(mesh.positions.len());
    for object in &mesh.objects {
        numbers[object.vertex_range()].shuffle(random);
    }
    let (mut changed, origins) = each_triangle(mesh, |_, triangle| {
        *triangle = triangle.map(|vertex| numbers[vertex as usize]);
    });
    for (number, position) in numbers.iter().zip(&mesh.positions) {
        changed.positions[*number as usize] = *position;
    }
    (changed, origins)
}

fn flip_closed_objects(mesh: &Mesh) -> Option<Retold> {
    let topology = Topology::build(mesh);
    let mut is_flipped = vec![false; mesh.triangles.len()];
    for (object, edges) in mesh.objects.iter().zip(&topology.object_edges) {
        let edges = &topology.edges[edges.start as usize..edges.end as usize];
        let is_closed = !edges.is_empty() && edges.iter().all(|edge| edge.opposite_count == 2);
        if is_closed && is_oriented(&mesh.triangles[object.triangle_range()]) {
            is_flipped[object.triangle_range()].fill(true);
        }
    }
    let flip = |i: usize, triangle: &mut [u32; 3]| {
        if is_flipped[i] {
            triangle.swap(1, 2);
        }
    };
    is_flipped
        .contains(&true)
        .then(|| each_triangle(mesh, flip))
}

/// Whether no two triangles run along an edge in the same direction.
fn is_oriented(triangles: &[[u32; 3]]) -> bool {
    let mut seen = HashSet::with_capacity(3 * triangles.len());
    let mut half_edges = triangles
        .iter()
        .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    half_edges.all(|half_edge| seen.insert(half_edge))
}

/// An object like `object` of some triangles of the mesh.
fn part(mesh: &Mesh, object: &Object, triangles: &[u32]) -> Part {
    let corners: Vec<_> = triangles
        .iter()
        .map(|t| mesh.corners(*t as usize))
        .collect();
    part_like(object, &corners)
}

/// An object like `object` of other triangles.
pub(super) fn part_like(object: &Object, triangles: &[[Vec3; 3]]) -> Part {
    let part = Part::of_triangles(&object.name, triangles);
    if object.casts_shadow {
        part
    } else {
        part.receiver()
    }
}

fn split_objects(mesh: &Mesh, random: &mut impl Rng) -> Option<Retold> {
    let (mut parts, mut origins) = (Vec::new(), Vec::new());
    for object in &mesh.objects {
        let (one, other): (Vec<u32>, Vec<u32>) = object
            .triangles
            .clone()
            .partition(|_| random.random_bool(0.5));
        for half in [one, other] {
            parts.push(part(mesh, object, &half));
            origins.extend(half);
        }
    }
    let changed: Mesh = parts.into_iter().collect();
    (changed.objects.len() > mesh.objects.len()).then_some((changed, origins))
}

fn merge_objects(mesh: &Mesh) -> Option<Retold> {
    let (mut parts, mut origins) = (Vec::new(), Vec::new());
    for casts_shadow in [true, false] {
        let mut alike = mesh
            .objects
            .iter()
            .filter(|o| o.casts_shadow == casts_shadow);
        let Some(first) = alike.clone().next() else {
            continue;
        };
        let triangles: Vec<u32> = alike.by_ref().flat_map(|o| o.triangles.clone()).collect();
        parts.push(part(mesh, first, &triangles));
        origins.extend(triangles);
    }
    let changed: Mesh = parts.into_iter().collect();
    (changed.objects.len() < mesh.objects.len()).then_some((changed, origins))
}

fn reorder_objects(mesh: &Mesh, random: &mut impl Rng) -> Option<Retold> {
    if mesh.objects.len() < 2 {
        return None;
    }
    let mut objects: Vec<_> = mesh.objects.iter().collect();
    objects.shuffle(random);
    let (mut changed, mut origins) = (Mesh::default(), Vec::new());
    for object in objects {
        let (vertex, triangle) = (changed.positions.len() as u32, origins.len() as u32);
        let moved = |corner: u32| corner - object.vertices.start + vertex;
        let triangles = mesh.triangles[object.triangle_range()].iter();
        changed
            .positions
            .extend(&mesh.positions[object.vertex_range()]);
        changed.triangles.extend(triangles.map(|t| t.map(moved)));
        origins.extend(object.triangles.clone());
        changed.objects.push(Object {
            name: object.name.clone(),
            vertices: vertex..changed.positions.len() as u32,
            triangles: triangle..origins.len() as u32,
            casts_shadow: object.casts_shadow,
        });
    }
    Some((changed, origins))
}

fn subdivide(mesh: &Mesh) -> Retold {
    let (mut parts, mut origins) = (Vec::new(), Vec::new());
    for object in &mesh.objects {
        let quarters: Vec<_> = object
            .triangle_range()
            .flat_map(|triangle| quarters(mesh.corners(triangle)))
            .collect();
        parts.push(part_like(object, &quarters));
        origins.extend(object.triangles.clone().flat_map(|t| [t; 4]));
    }
    (parts.into_iter().collect(), origins)
}

fn quarters([a, b, c]: [Vec3; 3]) -> [[Vec3; 3]; 4] {
    // The sum is the same from both sides of an edge: no gap opens there.
    let middle = |p: Vec3, q: Vec3| (p + q) / 2.0;
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// Larger, not smaller: positions stay on the grid of [canonical](crate::scene::mesh::canonical) ones.
fn scale(scene: &Scene, random: &mut impl Rng) -> Option<Changed> {
    /// Far from what overflows when three lengths are multiplied.
    const LARGEST: f32 = 1e9;
    let factor = 2f32.powi(random.random_range(1..=10));
    let Scene {
        mesh,
        camera,
        light,
        ..
    } = scene;
    let key = |key: &CameraKey| CameraKey {
        time_s: key.time_s,
        eye: key.eye * factor,
        target: key.target * factor,
    };
    let camera = CameraPath {
        keys: camera.keys.iter().map(key).collect(),
        near: camera.near * factor,
        ..camera.clone()
    };
    // A direction stays as it is.
    let light = (light.truncate() * if light.w == 0.0 { 1.0 } else { factor }).extend(light.w);
    let positions: Vec<_> = mesh.positions.iter().map(|p| *p * factor).collect();
    let points = positions
        .iter()
        .chain(camera.keys.iter().map(|key| &key.eye));
    let largest = points.fold(light.truncate().abs().max_element(), |largest, p| {
        largest.max(p.abs().max_element())
    });
    let origins = identity(mesh.triangles.len());
    let mesh = Mesh {
        positions,
        ..mesh.clone()
    };
    let (name, title) = (scene.name.clone(), scene.title.clone());
    (largest < LARGEST).then(|| Changed {
        scene: Scene::new(name, title, mesh, light, camera),
        origins,
    })
}

#[cfg(test)]
#[path = "change_tests.rs"]
mod tests;
