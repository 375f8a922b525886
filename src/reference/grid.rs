//! Pixels that the rasteriser's grid decides, not the geometry.
//!
//! A rasteriser moves vertices to its grid. A pixel whose centre an edge passes as near as that may be
//! drawn on either side of it, and a triangle may be drawn at a pixel whose centre lies beside it. Depth then
//! comes from the plane beyond the edge, where the order of the surface and of a shadow volume that starts
//! from that edge is turned round. What is right there is what is right at every place that the grid could show.

use glam::{DVec2, Vec3};

use super::contact::edge_volume;
use super::segment::ExactLight;
use super::surface::meets_well_inside;
use super::tree::Primitive;
use super::view::Projection;
use super::{Reference, Verdict, Visibility};

/// The step of the grid: eight bits below the pixel on every desktop GPU, as Direct3D asks for.
const GRID_PX: f64 = 1.0 / 256.0;

/// A light nearer to a triangle's plane, by this part of the volume that the light and the triangle could
/// span, may be on either side of it for a method that computes in 32 bits.
const SINGLE_PRECISION: f64 = 1e-5;

impl Projection {
    /// Whether an edge of a triangle passes a place, or misses it, by less than so many steps of the grid.
    pub(super) fn at_an_edge(&self, place_px: DVec2, corners: &[Vec3; 3], steps: f64) -> bool {
        let ray = self.ray(place_px);
        let angle = |step: DVec2| {
            let beside = self.ray(place_px + steps * GRID_PX * step);
            beside.direction.distance(ray.direction)
        };
        let angle = angle(DVec2::X).max(angle(DVec2::Y));
        !meets_well_inside(&ray, corners, angle)
    }
}

impl Reference {
    /// How much of the light reaches those of eight places around a pixel's centre, one step of the grid away, that show the
    /// surface of the triangle `own`: itself, a copy, or one that has a corner in common with it. What else is seen
    /// there is not what the pixel shows.
    pub(super) fn visibility_around(
        &self,
        projection: &Projection,
        centre_px: DVec2,
        own: &Primitive,
        light: ExactLight,
    ) -> impl Iterator<Item = Visibility> {
        let steps = (-1..=1).flat_map(|y| (-1..=1).map(move |x| (f64::from(x), f64::from(y))));
        let around = steps.filter(|step| *step != (0.0, 0.0));
        around.filter_map(move |(x, y)| {
            let place_px = centre_px + GRID_PX * DVec2::new(x, y);
            let (next, point) = self.visible(projection, place_px)?;
            let is_connected = next
                .corners
                .iter()
                .any(|corner| own.corners.contains(corner));
            is_connected.then(|| self.judge(next, point, projection.eye, light, &mut None))
        })
    }

    /// The verdict for the surface that is seen at a place in the picture.
    pub(super) fn verdict_at(
        &self,
        projection: &Projection,
        place_px: DVec2,
        light: ExactLight,
    ) -> Verdict {
        let seen = self.visible(projection, place_px);
        Verdict::of(
            seen.map(|(own, point)| self.judge(own, point, projection.eye, light, &mut None)),
        )
    }

    /// Whether the surface goes on all around a pixel's centre close to an edge of the triangle `own`, for
    /// so many steps of the grid: in `own` itself, in a copy of it, or across an edge from which no shadow
    /// volume starts. Near a corner, where a triangle that meets `own` in no edge may be next, it is taken
    /// not to.
    pub(super) fn goes_on(
        &self,
        projection: &Projection,
        centre_px: DVec2,
        own: &Primitive,
        light: ExactLight,
        steps: f64,
    ) -> bool {
        let around = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        around.into_iter().all(|(x, y)| {
            let place_px = centre_px + steps * GRID_PX * DVec2::new(x, y);
            let Some((next, _)) = self.visible(projection, place_px) else {
                return false;
            };
            let common = own.corners.map(|corner| next.corners.contains(&corner));
            match common {
                [true, true, true] => true,
                [true, true, false] => !self.is_silhouette([own.corners[0], own.corners[1]], light),
                [true, false, true] => !self.is_silhouette([own.corners[0], own.corners[2]], light),
                [false, true, true] => !self.is_silhouette([own.corners[1], own.corners[2]], light),
                _ => false,
            }
        })
    }

    /// Whether a shadow volume starts from an edge, or could by rounding: the light sees not as many
    /// triangles turn one way around it as the other.
    fn is_silhouette(&self, edge: [Vec3; 2], light: ExactLight) -> bool {
        let [from, to] = edge.map(Vec3::as_dvec3);
        let (light_point, is_point) = match light {
            ExactLight::Point(point) => (point, true),
            ExactLight::Direction(direction) => (direction, false),
        };
        let to_light = if is_point {
            light_point - from
        } else {
            light_point
        };
        let (mut multiplicity, mut is_certain) = (0, true);
        self.tree.visit_around((from + to) / 2.0, |triangle| {
            let Some(opposite) = opposite(&triangle.corners, edge).filter(|_| triangle.casts)
            else {
                return;
            };
            let (volume, _) = edge_volume(opposite.as_dvec3(), to_light, edge);
            let most = to_light.length() * (to - from).length();
            let most = most * (opposite.as_dvec3() - from).length();
            is_certain &= volume.abs() > SINGLE_PRECISION * most;
            multiplicity += if volume > 0.0 { 1 } else { -1 };
        });
        multiplicity != 0 || !is_certain
    }
}

/// The third corner of a triangle on an edge.
fn opposite(corners: &[Vec3; 3], edge: [Vec3; 2]) -> Option<Vec3> {
    let is_on_it = edge.iter().all(|end| corners.contains(end));
    let third = corners.iter().find(|corner| !edge.contains(corner));
    third.filter(|_| is_on_it).copied()
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{Scene, view};
    use super::*;
    use crate::scene::Light;
    use glam::Vec4;

    const LAMP: Light = Light::at(Vec4::new(0.3, 6.0, 0.2, 1.0));
    const SUN: Light = Light::at(Vec4::new(0.1, 1.0, 0.2, 0.0));

    /// A triangle on the edge along x, at a depth z, to its third corner.
    fn on_edge(z: f32, third: Vec3) -> [Vec3; 3] {
        [Vec3::new(-1.1, 0.0, z), Vec3::new(1.3, 0.0, z), third]
    }

    /// The verdict of the pixel in the middle of the picture, which looks straight down upon the origin. A
    /// pixel is 0.057 wide there.
    fn in_the_middle(casters: &[[Vec3; 3]], light: Light) -> Verdict {
        let view = view(Vec3::new(0.0, 5.0, 0.0), Vec3::ZERO, 101, 101);
        let (ids, mask) = Scene::default().cast(casters).trace(light, &view);
        assert_ne!(ids[50 * 101 + 50], 0, "something is there");
        mask.get(50, 50).unwrap()
    }

    const SOUTH: Vec3 = Vec3::new(0.2, 0.0, 1.4);
    const NORTH: Vec3 = Vec3::new(0.1, 0.0, -1.2);
    const BELOW: Vec3 = Vec3::new(0.1, -0.7, 0.2);

    #[test]
    fn a_surface_that_goes_on_is_decided() {
        let quad = [on_edge(0.0, SOUTH), on_edge(0.0, NORTH)];
        let twice = [quad, quad].concat();
        for light in [LAMP, SUN] {
            assert_eq!(in_the_middle(&quad, light), Verdict::Lit);
            assert_eq!(in_the_middle(&twice, light), Verdict::Lit);
        }
    }

    #[test]
    fn an_edge_alone_leaves_nothing_undecided() {
        for z in [-1e-4, -6e-4] {
            assert_eq!(in_the_middle(&[on_edge(z, SOUTH)], LAMP), Verdict::Lit);
        }
        // Shadow volumes start from the edge, and shadow nothing that is seen.
        let fin = [SOUTH, NORTH, BELOW].map(|third| on_edge(1e-4, third));
        for light in [LAMP, SUN] {
            assert_eq!(in_the_middle(&fin, light), Verdict::Lit);
        }
    }

    #[test]
    fn where_verdicts_differ_the_grid_decides_within_its_step() {
        // Behind the ridge the surface faces away from the light. A pixel is 0.057 wide.
        let ridge = |z| [on_edge(z, SOUTH), on_edge(z, Vec3::new(0.1, -0.6, -1.2))];
        let low_sun = Light::at(Vec4::new(0.0, 0.3, 1.0, 0.0));
        assert_eq!(in_the_middle(&ridge(-1e-4), low_sun), Verdict::Ambiguous);
        assert_eq!(in_the_middle(&ridge(-6e-4), low_sun), Verdict::Lit);
        // Its dark side is dark all over.
        assert_eq!(in_the_middle(&ridge(1e-4), low_sun), Verdict::Shadowed);
    }

    #[test]
    fn an_outline_before_something_else_is_decided() {
        // What lies below is in the shadow of what the pixel shows the very edge of.
        let roof = on_edge(-1e-4, SOUTH);
        let floor = [(-2.0, -2.0), (-2.0, 3.0), (4.0, -2.0)].map(|(x, z)| Vec3::new(x, -1.0, z));
        assert_eq!(in_the_middle(&[roof, floor], LAMP), Verdict::Lit);
    }
}
