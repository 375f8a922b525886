//! The planes of the triangles on an edge as points in four dimensions, and what rounding may do to a facing.
//!
//! A light `L` (homogeneous) and the plane `q` = (unit normal, -normal · point) of a triangle give `q · L`, the distance of
//! the light from the plane; its sign is the triangle's facing, wherever the distance is larger than rounding. So if all
//! planes of an edge lie on one side of the hyperplane `q · L = 0`, all its triangles have the same facing.

use crate::geometry::{Edge, Topology};
use crate::scene::mesh::Mesh;
use glam::{DVec3, DVec4, Vec4};

/// A facing is found in 32 bits by up to eight roundings, of 2⁻²⁴ each; the rest is for our own in 64 bits.
const ROUNDING: f64 = 10.0 / (1u64 << 24) as f64;

/// Edges with more triangles are always asked.
const MAX_TRIANGLES: usize = 64;

/// Where planes are measured from: close to the mesh, so that distances keep their digits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin(pub(super) DVec3);

/// A light as a hyperplane.
pub(super) struct DualLight {
    light: DVec4,
    /// Its components without signs: what rounding grows with.
    size: DVec4,
}

/// A box around planes.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneBox {
    pub(super) low: DVec4,
    pub(super) high: DVec4,
    /// With a light's `size`: how far rounding reaches, in units of [`ROUNDING`].
    pub(super) doubt: DVec4,
}

impl Origin {
    pub(super) fn light(self, light: Vec4) -> DualLight {
        let light = light.as_dvec4();
        let light = (light.truncate() - light.w * self.0).extend(light.w);
        DualLight {
            light,
            size: light.abs(),
        }
    }

    /// The planes of an edge's two triangles, the second turned around; `None` if it has not two with a plane.
    pub(super) fn pair(
        self,
        mesh: &Mesh,
        topology: &Topology,
        edge: Edge,
    ) -> Option<[PlaneBox; 2]> {
        let &[first, second] = topology.opposites_of(edge) else {
            return None;
        };
        let at = |vertex: u32| mesh.positions[vertex as usize].as_dvec3() - self.0;
        let (a, b) = (at(edge.a), at(edge.b));
        let other = PlaneBox::of(a, b, at(second))?.turned();
        Some([PlaneBox::of(a, b, at(first))?, other])
    }

    /// The planes of an edge's triangles, half of them turned around: such that the facings along the edge cancel
    /// wherever all these planes are on one side of the light's hyperplane. `None` for an edge that must always be
    /// asked, since its facings can hardly cancel or a triangle has no plane.
    pub(super) fn planes(self, mesh: &Mesh, topology: &Topology, edge: Edge) -> Option<PlaneBox> {
        let opposites = topology.opposites_of(edge);
        let is_even = opposites.len().is_multiple_of(2) && !opposites.is_empty();
        if !is_even || opposites.len() > MAX_TRIANGLES {
            return None;
        }
        let at = |vertex: u32| mesh.positions[vertex as usize].as_dvec3() - self.0;
        let (a, b) = (at(edge.a), at(edge.b));
        if let Some([one, other]) = self.pair(mesh, topology, edge) {
            return Some(one.union(&other));
        }
        let planes = opposites
            .iter()
            .map(|&opposite| PlaneBox::of(a, b, at(opposite)));
        let mut planes = planes.collect::<Option<Vec<_>>>()?;
        // The planes turn about the edge. A light sees as many from either side if it lies between those of one half
        // turn and the others; which half turn leaves the most room for it is tried out.
        let first = planes[0].low.truncate();
        let across = first.cross((b - a).normalize());
        let angle = |plane: &PlaneBox| {
            let normal = plane.low.truncate();
            normal.dot(across).atan2(normal.dot(first))
        };
        planes.sort_by(|one, other| angle(one).total_cmp(&angle(other)));
        let half = planes.len() / 2;
        let boxes = (0..half).map(|start| {
            let signed = planes.iter().enumerate().map(|(index, plane)| {
                let is_first_half = (start..start + half).contains(&index);
                if is_first_half {
                    *plane
                } else {
                    plane.turned()
                }
            });
            signed.reduce(|all, plane| all.union(&plane))
        });
        let extent = |planes: &PlaneBox| (planes.high - planes.low).truncate().length_squared();
        boxes
            .flatten()
            .min_by(|one, other| extent(one).total_cmp(&extent(other)))
    }
}

impl PlaneBox {
    /// Around no plane.
    pub(super) const EMPTY: Self = Self {
        low: DVec4::INFINITY,
        high: DVec4::NEG_INFINITY,
        doubt: DVec4::ZERO,
    };

    /// The plane of a triangle, positive where it looks counter-clockwise; `None` if it has none.
    fn of(a: DVec3, b: DVec3, c: DVec3) -> Option<Self> {
        let normal = (b - a).cross(c - a);
        let length = normal.length();
        // Products of two coordinates of up to 2³² are far from overflow.
        if length == 0.0 {
            return None;
        }
        let normal = normal / length;
        // Of three edges any two may be those that the facing is found with.
        let edges = (b - a).abs().max((c - b).abs()).max((a - c).abs());
        let products = DVec3::new(edges.y * edges.z, edges.z * edges.x, edges.x * edges.y);
        let products = 2.0 * products / length;
        let far = a.abs().max(b.abs()).max(c.abs());
        let plane = normal.extend(-normal.dot(a));
        Some(Self {
            low: plane,
            high: plane,
            doubt: products.extend(products.dot(far)),
        })
    }

    /// With the other sides for positive.
    fn turned(&self) -> Self {
        Self {
            low: -self.high,
            high: -self.low,
            doubt: self.doubt,
        }
    }

    /// The same planes, around one only, as points of the unit sphere.
    pub(super) fn on_unit_sphere(&self) -> Self {
        let scale = self.low.length_recip();
        Self {
            low: scale * self.low,
            high: scale * self.high,
            doubt: scale * self.doubt,
        }
    }

    pub(super) fn union(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            doubt: self.doubt.max(other.doubt),
        }
    }

    pub(super) fn centre(&self) -> DVec4 {
        0.5 * (self.low + self.high)
    }

    /// Whether all planes are on one side of the light's hyperplane, beyond all rounding. Two corners decide, picked by
    /// the signs of the light's components (Wallner 2006, section 2.1).
    pub(super) fn is_on_one_side(&self, light: &DualLight) -> bool {
        let (at_low, at_high) = (self.low * light.light, self.high * light.light);
        let least = at_low.min(at_high).element_sum();
        let most = at_low.max(at_high).element_sum();
        let doubt = ROUNDING * self.doubt.dot(light.size);
        least > doubt || most < -doubt
    }
}
