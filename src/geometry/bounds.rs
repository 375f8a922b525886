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

    /// The box that reaches so much farther on every side.
    pub fn larger_by(self, margin: f64) -> Self {
        Self {
            low: self.low - margin,
            high: self.high + margin,
        }
    }

    /// Whether there is no point in it.
    pub fn is_empty(self) -> bool {
        self.low.cmpgt(self.high).any()
    }

    /// Whether the two have a point in common, or nearly so, as far as single precision can tell.
    pub fn may_meet(self, other: Self) -> bool {
        let largest =
            [self, other].map(|bounds| bounds.low.abs().max(bounds.high.abs()).max_element());
        let margin = 4.0 * f64::from(f32::EPSILON) * largest[0].max(largest[1]);
        (self.low - margin).cmple(other.high).all() && (other.low - margin).cmple(self.high).all()
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
