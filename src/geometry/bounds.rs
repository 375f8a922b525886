//! Boxes around vertices.

use crate::scene::Mesh;
use glam::{DVec3, Vec3};

/// An axis-parallel box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Its smallest corner.
    pub low: DVec3,
    /// Its largest corner.
    pub high: DVec3,
}

impl Bounds {
    /// The box around no point at all.
    pub const EMPTY: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
    };

    /// The box around points; [`Self::EMPTY`] if there are none.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |bounds, p| Self {
            low: bounds.low.min(p.as_dvec3()),
            high: bounds.high.max(p.as_dvec3()),
        })
    }

    /// The box around both.
    pub fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Whether there is no point in it.
    pub fn is_empty(self) -> bool {
        self.low.cmpgt(self.high).any()
    }

    /// The boxes of all objects of a mesh, in their order.
    pub fn of_objects(mesh: &Mesh) -> Vec<Self> {
        let bounds = |vertices| Self::of(&mesh.positions[vertices]);
        mesh.objects
            .iter()
            .map(|object| bounds(object.vertex_range()))
            .collect()
    }

    /// The smallest and the largest value of `axis · p` over its points.
    pub fn range_along(self, axis: DVec3) -> (f64, f64) {
        let centre = (self.low + self.high) / 2.0;
        let reach = axis.abs().dot((self.high - self.low) / 2.0);
        let middle = axis.dot(centre);
        (middle - reach, middle + reach)
    }
}
