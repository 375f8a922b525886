//! Changes of a scene that do not change its shadow.
//!
//! A shadow depends on which points of space are covered by triangles, not on how the triangles are told:
//! in which order, in which objects, wound which way, cut how. A method whose picture changes with the
//! telling is wrong in one of the two pictures, and no truth is needed to see that: *metamorphic testing*
//! (Chen, Cheung, Yiu 1998).

use super::rewrite::{self, Changed};
use crate::scene::Scene;
use rand::{Rng, RngExt};
use std::sync::Arc;

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
    /// The mask but for pixels at the true shadow boundary, which last bits decide.
    AllButBoundary,
}

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
            // Copies of a side quad that cancel within one object's edge are drawn from two edges instead. A
            // tessellator may begin the two at different vertices: their last bits of depth then differ.
            Self::SplitObjects | Self::MergeObjects => Keeps::AllButBoundary,
            // A rasteriser takes a triangle's plane from its first vertex: the last bits of the surface's depth differ.
            Self::RotateVertices => Keeps::AllButBoundary,
            // The middles of edges are rounded, which moves the surface.
            Self::Subdivide => Keeps::AllButBoundary,
            _ => Keeps::EveryPixel,
        }
    }

    /// The scene after the change. `None` where it does not apply: no object is closed, there is but one
    /// object, there is nothing to split.
    pub fn apply(self, scene: &Scene, random: &mut impl Rng) -> Option<Changed> {
        let mesh = &*scene.mesh;
        let (mesh, origins) = match self {
            Self::Again => (mesh.clone(), rewrite::identity(mesh.triangles.len())),
            Self::ReorderTriangles => rewrite::reorder_triangles(mesh, random),
            Self::RenumberVertices => rewrite::renumber_vertices(mesh, random),
            Self::RotateVertices => {
                rewrite::each_triangle(mesh, |_, t| t.rotate_left(random.random_range(0..3)))
            }
            Self::FlipTriangles => rewrite::each_triangle(mesh, |_, t| {
                if random.random_bool(0.5) {
                    t.swap(1, 2);
                }
            }),
            Self::FlipClosedObjects => rewrite::flip_closed_objects(mesh)?,
            Self::SplitObjects => rewrite::split_objects(mesh, random)?,
            Self::MergeObjects => rewrite::merge_objects(mesh)?,
            Self::ReorderObjects => rewrite::reorder_objects(mesh, random)?,
            Self::Scale => return rewrite::scale(scene, random),
            Self::Subdivide => rewrite::subdivide(mesh),
        };
        let mut changed = scene.clone();
        changed.mesh_hash = mesh.hash();
        changed.mesh = Arc::new(mesh);
        Some(Changed {
            scene: changed,
            origins,
        })
    }
}

#[cfg(test)]
#[path = "change_tests.rs"]
mod tests;
