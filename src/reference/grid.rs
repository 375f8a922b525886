//! Pixels that the rasteriser's grid decides, not the geometry.
//!
//! A rasteriser moves vertices to its grid. A pixel whose centre an edge passes as near as that may be
//! drawn on either side of it, and a triangle may be drawn at a pixel whose centre lies beside it. Depth then
//! comes from the plane beyond the edge, where the order of the surface and of a shadow volume that starts
//! from that edge is turned round. Where the surface ends on such an edge, or a shadow volume starts from
//! it, there is no telling what is right.

use glam::{DVec2, Vec3};

use super::Reference;
use super::contact::edge_volume;
use super::segment::Light;
use super::surface::meets_well_inside;
use super::tree::Primitive;
use super::view::Projection;

/// The step of the grid: eight bits below the pixel on every desktop GPU, as Direct3D asks for.
const GRID_PX: f64 = 1.0 / 256.0;

/// A light nearer to a triangle's plane, by this part of the volume that the light and the triangle could
/// span, may be on either side of it for a method that computes in 32 bits.
const SINGLE_PRECISION: f64 = 1e-5;

impl Projection {
    /// Whether an edge of a triangle passes a place, or misses it, by less than so many steps of the grid
    /// can tell.
    pub(super) fn at_an_edge(&self, place_px: DVec2, corners: &[Vec3; 3], steps: f64) -> bool {
        let middle_px = self.size_px / 2.0;
        let beside_px = middle_px + steps * GRID_PX;
        // An angle is largest in the middle of the picture.
        let [one, other] = [middle_px, beside_px].map(|at| self.ray(at).direction);
        !meets_well_inside(&self.ray(place_px), corners, one.distance(other))
    }
}

impl Reference {
    /// Whether the surface goes on all around a pixel's centre close to an edge of the triangle `own`, in
    /// `own` itself or across an edge from which no shadow volume starts.
    pub(super) fn goes_on(
        &self,
        projection: &Projection,
        centre_px: DVec2,
        own: &Primitive,
        light: Light,
    ) -> bool {
        let around = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        around.into_iter().all(|(x, y)| {
            let place_px = centre_px + GRID_PX * DVec2::new(x, y);
            let next = self.visible(projection, place_px);
            next.is_some_and(|(next, _)| {
                next.triangle == own.triangle
                    || common_edge(&own.corners, &next.corners)
                        .is_some_and(|edge| !self.is_silhouette(edge, light))
            })
        })
    }

    /// Whether a shadow volume starts from an edge, or could by rounding: the light sees not as many
    /// triangles turn one way around it as the other.
    fn is_silhouette(&self, edge: [Vec3; 2], light: Light) -> bool {
        let [from, to] = edge.map(Vec3::as_dvec3);
        let (light_point, is_point) = match light {
            Light::Point(point) => (point, true),
            Light::Direction(direction) => (direction, false),
        };
        let to_light = if is_point {
            light_point - from
        } else {
            light_point
        };
        let mut multiplicity = 0;
        for triangle in self.tree.around((from + to) / 2.0) {
            let Some(opposite) = opposite(&triangle.corners, edge).filter(|_| triangle.casts)
            else {
                continue;
            };
            let (volume, _) = edge_volume(opposite.as_dvec3(), to_light, edge);
            let most = to_light.length() * (to - from).length();
            let most = most * (opposite.as_dvec3() - from).length();
            if volume.abs() <= SINGLE_PRECISION * most {
                return true;
            }
            multiplicity += if volume > 0.0 { 1 } else { -1 };
        }
        multiplicity != 0
    }
}

/// The two corners that triangles have in common, if two.
fn common_edge(one: &[Vec3; 3], other: &[Vec3; 3]) -> Option<[Vec3; 2]> {
    let mut common = one.iter().filter(|corner| other.contains(corner));
    Some([*common.next()?, *common.next()?])
}

/// The third corner of a triangle on an edge.
fn opposite(corners: &[Vec3; 3], edge: [Vec3; 2]) -> Option<Vec3> {
    let is_on_it = edge.iter().all(|end| corners.contains(end));
    let third = corners.iter().find(|corner| !edge.contains(corner));
    third.filter(|_| is_on_it).copied()
}
