//! Objects with vertices of their own, and how they become one mesh.

use super::mesh::{Mesh, Object, canonical};
use super::weld::weld;
use glam::Vec3;

/// One object on its own, with indices into its own vertices; these are canonical, each is used, and no two
/// are at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// See [`Object::name`].
    pub name: String,
    pub(super) positions: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// See [`Object::casts_shadow`].
    pub casts_shadow: bool,
}

impl Part {
    /// From vertices, which become canonical and one where they are at the same place, and indices into
    /// them. It casts a shadow.
    ///
    /// # Panics
    /// When an index is out of range.
    pub fn new(name: &str, positions: &[Vec3], mut triangles: Vec<[u32; 3]>) -> Self {
        let positions: Vec<Vec3> = positions.iter().map(|p| canonical(*p)).collect();
        let positions = weld(&positions, &mut triangles);
        Self {
            name: name.to_owned(),
            positions,
            triangles,
            casts_shadow: true,
        }
    }

    /// From the corners of triangles, as [`Self::new`].
    pub fn of_triangles(name: &str, triangles: &[[Vec3; 3]]) -> Self {
        let first = |triangle: usize| 3 * triangle as u32;
        let indices = (0..triangles.len()).map(|i| [first(i), first(i) + 1, first(i) + 2]);
        Self::new(name, triangles.as_flattened(), indices.collect())
    }

    /// The same as something that only receives shadows.
    #[must_use]
    pub fn receiver(self) -> Self {
        Self {
            casts_shadow: false,
            ..self
        }
    }
}

impl Mesh {
    /// The mesh of those triangles whose numbers `keep` takes, made of [`Part`]s: without the vertices and
    /// objects that no triangle uses, vertices at one place in an object being one, numbered as the triangles
    /// first use them.
    #[must_use]
    pub fn filtered(&self, keep: impl Fn(usize) -> bool) -> Self {
        let part = |object: &Object| {
            let kept = object.triangle_range().filter(|triangle| keep(*triangle));
            let corners: Vec<_> = kept.map(|triangle| self.corners(triangle)).collect();
            Part {
                casts_shadow: object.casts_shadow,
                ..Part::of_triangles(&object.name, &corners)
            }
        };
        self.objects.iter().map(part).collect()
    }
}

impl FromIterator<Part> for Mesh {
    /// An object for each part that has triangles.
    fn from_iter<I: IntoIterator<Item = Part>>(parts: I) -> Self {
        let mut mesh = Self::default();
        for part in parts {
            mesh.push(&part);
        }
        mesh
    }
}

impl Mesh {
    /// Adds an object, if the part has triangles.
    pub fn push(&mut self, part: &Part) {
        if part.triangles.is_empty() {
            return;
        }
        let vertex = self.positions.len() as u32;
        let triangle = self.triangles.len() as u32;
        self.positions.extend(&part.positions);
        let triangles = part.triangles.iter();
        self.triangles
            .extend(triangles.map(|t| t.map(|corner| vertex + corner)));
        self.objects.push(Object {
            name: part.name.clone(),
            vertices: vertex..self.positions.len() as u32,
            triangles: triangle..self.triangles.len() as u32,
            casts_shadow: part.casts_shadow,
        });
    }
}
