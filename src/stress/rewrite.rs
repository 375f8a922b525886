//! Meshes written another way: how [`Change`](super::Change)s are made.

use crate::geometry::Topology;
use crate::scene::{
    CameraKey, CameraPath, Flight, LightKey, LightKeys, LightPath, Mesh, Object, Part, Scene,
};
use glam::Vec3;
use rand::seq::SliceRandom;
use rand::{Rng, RngExt};
use std::collections::HashSet;

/// A scene whose shadow is that of another.
#[derive(Debug, Clone, PartialEq)]
pub struct Changed {
    /// The scene.
    pub scene: Scene,
    /// Of each triangle, the one of the scene before that it is, or is a part of.
    pub origins: Vec<u32>,
}

/// A mesh, and of each triangle the one that it comes from.
pub(super) type Rewritten = (Mesh, Vec<u32>);

pub(super) fn identity(count: usize) -> Vec<u32> {
    (0..count as u32).collect()
}

/// The same mesh with each triangle changed in place.
pub(super) fn each_triangle(
    mesh: &Mesh,
    mut change: impl FnMut(usize, &mut [u32; 3]),
) -> Rewritten {
    let mut changed = mesh.clone();
    let triangles = changed.triangles.iter_mut().enumerate();
    triangles.for_each(|(i, triangle)| change(i, triangle));
    (changed, identity(mesh.triangles.len()))
}

pub(super) fn reorder_triangles(mesh: &Mesh, random: &mut impl Rng) -> Rewritten {
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

pub(super) fn renumber_vertices(mesh: &Mesh, random: &mut impl Rng) -> Rewritten {
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

pub(super) fn flip_closed_objects(mesh: &Mesh) -> Option<Rewritten> {
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

pub(super) fn split_objects(mesh: &Mesh, random: &mut impl Rng) -> Option<Rewritten> {
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

pub(super) fn merge_objects(mesh: &Mesh) -> Option<Rewritten> {
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

pub(super) fn reorder_objects(mesh: &Mesh, random: &mut impl Rng) -> Option<Rewritten> {
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

pub(super) fn subdivide(mesh: &Mesh) -> Rewritten {
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
pub(super) fn scale(scene: &Scene, random: &mut impl Rng) -> Option<Changed> {
    /// Far from what overflows when three lengths are multiplied.
    const LARGEST: f32 = 1e9;
    let factor = 2f32.powi(random.random_range(1..=10));
    let mesh = &scene.mesh;
    let Flight { camera, light } = &scene.flight;
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
    let light = scaled_light(light, factor);
    let positions: Vec<_> = mesh.positions.iter().map(|p| *p * factor).collect();
    let largest = positions
        .iter()
        .chain(camera.keys.iter().map(|key| &key.eye))
        .chain(light_places(&light))
        .fold(0f32, |largest, p| largest.max(p.abs().max_element()));
    let origins = identity(mesh.triangles.len());
    let mesh = Mesh {
        positions,
        ..Mesh::clone(mesh)
    };
    let (name, title) = (scene.name.clone(), scene.title.clone());
    (largest < LARGEST).then(|| Changed {
        scene: Scene::new(name, title, mesh, Flight { camera, light }),
        origins,
    })
}

/// A direction stays as it is, and so does the sun.
fn scaled_light(light: &LightPath, factor: f32) -> LightPath {
    let LightPath::Keys(keys) = light else {
        return light.clone();
    };
    let towards = if keys.w == 0.0 { 1.0 } else { factor };
    let key = |key: &LightKey| LightKey {
        time_s: key.time_s,
        place: key.place * towards,
    };
    LightPath::Keys(LightKeys {
        keys: keys.keys.iter().map(key).collect(),
        radius: keys.radius * towards,
        ..*keys
    })
}

/// Where a light's keys are.
fn light_places(light: &LightPath) -> impl Iterator<Item = &Vec3> {
    let keys = match light {
        LightPath::Keys(keys) => &keys.keys[..],
        LightPath::Sun(_) => &[],
    };
    keys.iter().map(|key| &key.place)
}
