//! The light's frustum: the smallest that covers the casters.

use crate::geometry::Bounds;
use crate::scene::Mesh;
use crate::scene::mesh::Object;
use glam::{DVec3, DVec4, Mat4, Vec3, Vec4};
use rayon::prelude::*;

/// Widest half-angle of a perspective map: beyond it, texels at the rim cover hardly anything.
const MAX_HALF_ANGLE_DEG: f64 = 75.0;

/// The near plane of a perspective map lies at this part of the distance of the farthest caster at least.
/// Reversed floating-point depth is as precise whatever it is.
pub(super) const NEAR_BY_FAR: f64 = 1e-6;

/// The window is made this much larger, so that no caster touches the rim of the map; and depth by as much of the
/// casters' size.
const MARGIN: f64 = 1e-3;

/// A frustum from the light.
#[derive(Debug, Clone)]
pub(super) struct LightFrustum {
    /// What the matrix takes places relative to: the middle of the casters, so that neither a light nor an
    /// origin of the world that is far away costs digits.
    pub origin: Vec3,
    /// To the map's clip space: x right, y up, depth 1 at the nearest caster, 0 at the farthest.
    pub view_projection: Mat4,
    /// What a step of 1 towards the light adds to clip space.
    pub step: Vec4,
    /// Part of the casters' vertices that it covers, 0 to 1.
    pub covered: f64,
}

/// Directions of the light's view: right, up, forward.
struct Axes {
    origin: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
}

impl Axes {
    fn new(origin: DVec3, forward: DVec3) -> Self {
        let forward = forward.normalize_or(DVec3::NEG_Y);
        let helper = if forward.y.abs() > 0.9 {
            DVec3::X
        } else {
            DVec3::Y
        };
        let right = forward.cross(helper).normalize();
        Self {
            origin,
            right,
            up: right.cross(forward),
            forward,
        }
    }

    fn local(&self, p: DVec3) -> DVec3 {
        let d = p - self.origin;
        DVec3::new(d.dot(self.right), d.dot(self.up), d.dot(self.forward))
    }

    /// The row of a matrix that gives `weights · local(p) + constant`, for p relative to `about`.
    fn row(&self, about: DVec3, weights: DVec3, constant: f64) -> DVec4 {
        let row = self.right * weights.x + self.up * weights.y + self.forward * weights.z;
        row.extend(constant + weights.dot(self.local(about)))
    }
}

/// Range of the casters in the light's view: window (x over depth and y over depth for a point
/// light, plain x and y for one at infinity) and depth.
#[derive(Clone, Copy)]
struct Extent {
    low: DVec3,
    high: DVec3,
    covered: usize,
}

/// What a matrix is made for.
struct FrustumFit {
    extent: Extent,
    /// The longest side of the casters' box.
    longest: f64,
    is_point: bool,
    /// What the matrix takes places relative to.
    about: DVec3,
}

impl Extent {
    const EMPTY: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
        covered: 0,
    };

    fn with(self, p: DVec3) -> Self {
        Self {
            low: self.low.min(p),
            high: self.high.max(p),
            covered: self.covered + 1,
        }
    }

    fn union(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            covered: self.covered + other.covered,
        }
    }
}

/// The vertices of everything that casts: all that a frustum depends on beside the light.
pub(super) struct CasterVertices {
    positions: Vec<Vec3>,
    bounds: Extent,
}

impl CasterVertices {
    pub(super) fn of(mesh: &Mesh) -> Self {
        let vertices = |object: &Object| &mesh.positions[object.vertex_range()];
        let positions: Vec<_> = mesh.casters().flat_map(vertices).copied().collect();
        let bounds = positions
            .par_iter()
            .fold(|| Extent::EMPTY, |extent, p| extent.with(p.as_dvec3()))
            .reduce(|| Extent::EMPTY, Extent::union);
        Self { positions, bounds }
    }

    /// What of them the widest frustum along `axes` sees, in its window and along its depth; `None` if nothing.
    fn window(&self, axes: &Axes, is_point: bool) -> Option<Extent> {
        let max_tangent = MAX_HALF_ANGLE_DEG.to_radians().tan();
        let window = |p: DVec3| {
            let local = axes.local(p);
            if !is_point {
                return Some(local);
            }
            let tangents = (local.truncate() / local.z).extend(local.z);
            (local.z > 0.0 && tangents.truncate().abs().max_element() <= max_tangent)
                .then_some(tangents)
        };
        let extent = self
            .positions
            .par_iter()
            .filter_map(|p| window(p.as_dvec3()))
            .fold(|| Extent::EMPTY, Extent::with)
            .reduce(|| Extent::EMPTY, Extent::union);
        if extent.covered == 0 {
            return None;
        }
        let bounds = self.bounds;
        if extent.covered == bounds.covered {
            return Some(extent);
        }
        // A triangle may have corners outside and be seen inside: no depth of what is before the light is cut away.
        let Extent { low, high, .. } = bounds;
        let (_, farthest) = Bounds { low, high }.range_along(axes.forward);
        Some(Extent {
            low: extent.low.with_z(0.0),
            high: extent.high.with_z(farthest - axes.forward.dot(axes.origin)),
            ..extent
        })
    }
}

impl LightFrustum {
    /// Covers all vertices of `casters`; those that lie outside the widest frustum (beside or
    /// behind a point light among the casters) are left out. `None` if none can be covered.
    pub(super) fn around(casters: &CasterVertices, light: Vec4) -> Option<Self> {
        let bounds = casters.bounds;
        let centre = (bounds.low + bounds.high) / 2.0;
        let is_point = light.w != 0.0;
        let position = light.truncate().as_dvec3();
        let axes = if is_point {
            Axes::new(position, centre - position)
        } else {
            Axes::new(centre, -position)
        };
        let extent = casters.window(&axes, is_point)?;
        let origin = centre.as_vec3();
        let fit = FrustumFit {
            extent,
            longest: (bounds.high - bounds.low).max_element(),
            is_point,
            about: origin.as_dvec3(),
        };
        let rows = fit.rows(&axes);
        let step = rows.map(|row| -row.truncate().dot(axes.forward));
        Some(Self {
            origin,
            view_projection: Mat4::from_cols_array_2d(&rows.map(|row| row.as_vec4().to_array()))
                .transpose(),
            step: DVec4::from_array(step).as_vec4(),
            covered: extent.covered as f64 / bounds.covered as f64,
        })
    }
}

impl FrustumFit {
    /// The rows of the matrix.
    fn rows(&self, axes: &Axes) -> [DVec4; 4] {
        let Extent { low, high, .. } = self.extent;
        let size = (high - low).max(DVec3::splat(f64::MIN_POSITIVE));
        let middle = (high + low) / 2.0;
        let scale = 2.0 / (size * (1.0 + 2.0 * MARGIN));
        // Far above rounding, and of no account to the precision of depth.
        let margin = MARGIN * self.longest.max(f64::MIN_POSITIVE);
        let far = high.z + margin;
        let row = |weights, constant| axes.row(self.about, weights, constant);
        if self.is_point {
            let near = (low.z - margin).max(far * NEAR_BY_FAR);
            let k = near / (far - near);
            // Window coordinates are divided by depth: the middle moves with it.
            [
                row(DVec3::new(scale.x, 0.0, -middle.x * scale.x), 0.0),
                row(DVec3::new(0.0, scale.y, -middle.y * scale.y), 0.0),
                row(DVec3::NEG_Z * k, k * far),
                row(DVec3::Z, 0.0),
            ]
        } else {
            let k = 1.0 / (far - (low.z - margin));
            [
                row(DVec3::X * scale.x, -middle.x * scale.x),
                row(DVec3::Y * scale.y, -middle.y * scale.y),
                row(DVec3::NEG_Z * k, k * far),
                DVec4::W,
            ]
        }
    }
}

#[cfg(test)]
#[path = "frustum_tests.rs"]
mod tests;
