//! The planes of the triangles on an edge as points in four dimensions, and what rounding may do to a facing.
//!
//! A light `L` (homogeneous) and the plane `q` = (unit normal, -normal · point) of a triangle give `q · L`, the distance of
//! the light from the plane; its sign is the triangle's facing, wherever the distance is larger than rounding. So if all
//! planes of an edge lie on one side of the hyperplane `q · L = 0`, all its triangles have the same facing.
//!
//! Planes are found in 64 bits and held against a light in 32; those of edges are kept in 16, along the sides of a box.

use super::lanes::{DualLight, OneBox};
use crate::geometry::{Bounds, Edge, Topology};
use crate::scene::mesh::Mesh;
use glam::{DVec2, DVec3, DVec4, Vec2, Vec3, Vec4};

/// How far lights are along an axis, in radii of the mesh. On the sphere grids trees ask fewest edges with 0.25 to 0.5, 10 %
/// more with 1 or 0.1; Sponza hardly minds.
const LIGHT_ALONG_AXIS: f32 = 0.3;

/// Edges with more triangles are always asked.
const MAX_TRIANGLES: usize = 64;

/// Where planes are measured from: close to the mesh, so that distances keep their digits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    place: DVec3,
    /// Half the diagonal of the mesh's box.
    radius: f64,
}

/// A box around planes, and how much rounding there is in a distance from one of them.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneBox {
    pub(super) low: DVec4,
    pub(super) high: DVec4,
    /// By so much rounding grows with the light's place, and with its `w`: not less than any component of the planes, and
    /// than those of the last.
    pub(super) doubt: DVec2,
}

/// What is known of an edge by the planes of its triangles, in 32 bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgePlanes {
    pub(super) kind: EdgeKind,
    /// Of two triangles, the second turned around; else the corners of a box; of a boundary edge, the one plane twice.
    pub(super) points: [Vec4; 2],
    /// See [`PlaneBox::doubt`].
    pub(super) doubt: Vec2,
}

/// Edges by what their planes tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum EdgeKind {
    /// Two triangles with a plane each.
    Pair,
    /// More triangles, half of whose planes were turned around: such that the facings along the edge cancel wherever all
    /// these planes are on one side of the light's hyperplane.
    Box,
    /// One triangle, with a plane: on the silhouette for nearly every light.
    Boundary,
    /// Nothing: its facings can hardly cancel, or a triangle has no plane.
    Unknown,
}

impl Origin {
    /// That of the mesh's own coordinates.
    pub(super) const WORLD: Self = Self {
        place: DVec3::ZERO,
        radius: 1.0,
    };

    /// The middle of a mesh.
    pub(super) fn of(mesh: &Mesh) -> Self {
        let Bounds { low, high } = Bounds::of(&mesh.positions);
        Self {
            place: 0.5 * (low + high),
            radius: 0.5 * (high - low).length(),
        }
    }

    pub(super) fn light(self, light: Vec4) -> DualLight {
        let light = light.as_dvec4();
        DualLight::new((light.truncate() - light.w * self.place).extend(light.w))
    }

    /// The plane of the triangle of an edge and one of its opposite vertices, positive where the light sees the
    /// triangle on the left of the edge; `None` if it has none.
    pub(super) fn plane(self, mesh: &Mesh, edge: Edge, opposite: u32) -> Option<PlaneBox> {
        let at = |vertex: u32| mesh.positions[vertex as usize].as_dvec3() - self.place;
        PlaneBox::of(at(edge.a), at(edge.b), at(opposite))
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
        let first = self.plane(mesh, edge, first)?;
        Some([first, self.plane(mesh, edge, second)?.turned()])
    }

    /// What the planes of an edge's triangles tell of it.
    pub(super) fn of_edge(self, mesh: &Mesh, topology: &Topology, edge: Edge) -> EdgePlanes {
        let opposites = topology.opposites_of(edge);
        let is_even = opposites.len().is_multiple_of(2);
        let known = match opposites {
            [opposite] => self
                .plane(mesh, edge, *opposite)
                .map(|plane| EdgePlanes::new(EdgeKind::Boundary, &plane, &plane)),
            [_, _] => self
                .pair(mesh, topology, edge)
                .map(|[one, other]| EdgePlanes::new(EdgeKind::Pair, &one, &other)),
            _ if is_even && opposites.len() <= MAX_TRIANGLES => self
                .halves(mesh, edge, opposites)
                .map(|planes| EdgePlanes::new(EdgeKind::Box, &planes, &planes)),
            _ => None,
        };
        known.unwrap_or(EdgePlanes::UNKNOWN)
    }

    /// A box around the planes of an even number of triangles, half of them turned around.
    fn halves(self, mesh: &Mesh, edge: Edge, opposites: &[u32]) -> Option<PlaneBox> {
        let planes = opposites
            .iter()
            .map(|&opposite| self.plane(mesh, edge, opposite));
        let mut planes = planes.collect::<Option<Vec<_>>>()?;
        // The planes turn about the edge. A light sees as many from either side if it lies between those of one half
        // turn and the others; which half turn leaves the most room for it is tried out.
        let at = |vertex: u32| mesh.positions[vertex as usize].as_dvec3();
        let first = planes[0].low.truncate();
        let across = first.cross((at(edge.b) - at(edge.a)).normalize());
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

    /// The middle of an edge's planes, its components weighed by how much they move a light's distance: a part of a normal
    /// counts by that of the light's place along it.
    pub(super) fn centre(self, planes: &EdgePlanes) -> Vec4 {
        let weights = Vec3::splat(LIGHT_ALONG_AXIS * self.radius as f32).extend(1.0);
        weights * (planes.points[0] + planes.points[1])
    }
}

impl EdgePlanes {
    const UNKNOWN: Self = Self {
        kind: EdgeKind::Unknown,
        points: [Vec4::ZERO; 2],
        doubt: Vec2::INFINITY,
    };

    fn new(kind: EdgeKind, one: &PlaneBox, other: &PlaneBox) -> Self {
        Self {
            kind,
            points: [one.low.as_vec4(), other.high.as_vec4()],
            doubt: one.doubt32().max(other.doubt32()),
        }
    }
}

impl PlaneBox {
    /// The plane of a triangle, positive where it looks counter-clockwise; `None` if it has none.
    fn of(a: DVec3, b: DVec3, c: DVec3) -> Option<Self> {
        let normal = (b - a).cross(c - a);
        let length = normal.length();
        // Products of two coordinates of up to 2³² are far from overflow.
        if length == 0.0 {
            return None;
        }
        let per_length = length.recip();
        let normal = per_length * normal;
        // Of three edges any two may be those that the facing is found with.
        let edges = (b - a).abs().max((c - b).abs()).max((a - c).abs());
        let products = DVec3::new(edges.y * edges.z, edges.z * edges.x, edges.x * edges.y);
        let products = 2.0 * per_length * products;
        let far = a.abs().max(b.abs()).max(c.abs());
        let plane = normal.extend(-normal.dot(a));
        Some(Self {
            low: plane,
            high: plane,
            doubt: DVec2::new(products.max_element(), products.dot(far)),
        })
    }

    /// With the other sides for positive.
    pub(super) fn turned(&self) -> Self {
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

    /// Its doubt in 32 bits, not less.
    pub(super) fn doubt32(&self) -> Vec2 {
        const UP: f64 = 1.0 + 2.0 * f32::EPSILON as f64;
        (UP * self.doubt).as_vec2()
    }
}

impl From<&PlaneBox> for OneBox {
    fn from(planes: &PlaneBox) -> Self {
        Self {
            low: planes.low.as_vec4(),
            high: planes.high.as_vec4(),
            doubt: planes.doubt32(),
        }
    }
}

impl From<&EdgePlanes> for OneBox {
    fn from(planes: &EdgePlanes) -> Self {
        let [one, other] = planes.points;
        Self {
            low: one.min(other),
            high: one.max(other),
            doubt: planes.doubt,
        }
    }
}
