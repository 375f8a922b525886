//! How often the side quads of shadow volumes cover the picture.

use crate::frame::SceneExtents;
use crate::geometry::silhouette::{PlaneTree, SilhouetteEdge};
use crate::geometry::{EndPlane, EndPlanes, Topology};
use crate::scene::{Mesh, Moment};
use glam::{DVec2, DVec4, Vec4};

/// How often side quads cover a pixel on average, in front of what is visible or behind, by where volumes end.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Overdraw {
    /// At infinity.
    pub infinity: f64,
    /// On the one plane beside the scene on which all may end.
    pub scene: f64,
    /// Each object's on the plane that is best for it.
    pub object: f64,
}

/// What overdraw is found from.
pub(super) struct SideQuads<'a> {
    mesh: &'a Mesh,
    topology: &'a Topology,
    extents: &'a SceneExtents,
    tree: PlaneTree,
    /// The caster of each edge.
    casters: Vec<u32>,
    found: Vec<SilhouetteEdge>,
}

impl<'a> SideQuads<'a> {
    pub(super) fn new(mesh: &'a Mesh, topology: &'a Topology, extents: &'a SceneExtents) -> Self {
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let of_casters = objects.filter(|(object, _)| object.casts_shadow);
        let mut casters = vec![0; topology.edges.len()];
        for (caster, (_, edges)) in (0..).zip(of_casters) {
            casters[edges.start as usize..edges.end as usize].fill(caster);
        }
        Self {
            mesh,
            topology,
            extents,
            tree: PlaneTree::build(mesh, topology),
            casters,
            found: Vec::new(),
        }
    }

    /// Their overdraw at a moment, in a picture of this size.
    pub(super) fn overdraw(&mut self, moment: &Moment, (width, height): (u32, u32)) -> Overdraw {
        let light = moment.light.place;
        let Self {
            mesh,
            topology,
            found,
            ..
        } = self;
        self.tree.silhouette(mesh, topology, light, found);
        let ends = EndPlanes::new(self.extents.scene, light, &[]);
        let planes = ends.coefficients();
        let of_casters: Vec<_> = self.extents.casters.iter().map(|b| ends.of(*b)).collect();
        let of_scene = ends.of(self.extents.all_casters);
        let size = DVec2::new(width.into(), height.into());
        let projection = moment.view.view_projection(width as f32 / height as f32);
        let mut covered = [0.0; 3];
        for found in &*found {
            let edge = topology.edges[found.edge as usize];
            let ends = [edge.a, edge.b].map(|vertex| mesh.positions[vertex as usize].extend(1.0));
            let own = of_casters[self.casters[found.edge as usize] as usize];
            for (covered, end) in covered.iter_mut().zip([EndPlane::INFINITY, of_scene, own]) {
                let plane = planes[end.index()];
                let far = |p: Vec4| p * plane.dot(light) - light * plane.dot(p);
                let quad = [ends[0], ends[1], far(ends[1]), far(ends[0])];
                let corners = quad.map(|corner| (projection * corner).as_dvec4());
                *covered += f64::from(found.multiplicity.abs()) * visible_area(&corners, size);
            }
        }
        let [infinity, scene, object] = covered.map(|area| area / (size.x * size.y));
        Overdraw {
            infinity,
            scene,
            object,
        }
    }
}

/// The area in pixels of a flat polygon in clip space that is within the view frustum.
fn visible_area(corners: &[DVec4], size: DVec2) -> f64 {
    const SIDES: [DVec4; 5] = [
        DVec4::new(1.0, 0.0, 0.0, 1.0),
        DVec4::new(-1.0, 0.0, 0.0, 1.0),
        DVec4::new(0.0, 1.0, 0.0, 1.0),
        DVec4::new(0.0, -1.0, 0.0, 1.0),
        // Reversed depth: z is at most w.
        DVec4::new(0.0, 0.0, -1.0, 1.0),
    ];
    let clipped = SIDES
        .iter()
        .fold(corners.to_vec(), |polygon, side| clip(&polygon, *side));
    let at = |corner: &DVec4| DVec2::new(corner.x, corner.y) / corner.w * size / 2.0;
    let next = clipped.iter().cycle().skip(1);
    let twice: f64 = clipped
        .iter()
        .zip(next)
        .map(|(one, next)| at(one).perp_dot(at(next)))
        .sum();
    twice.abs() / 2.0
}

/// What of a polygon is on the inner side of a plane (Sutherland and Hodgman 1974).
fn clip(polygon: &[DVec4], side: DVec4) -> Vec<DVec4> {
    let mut clipped = Vec::with_capacity(polygon.len() + 1);
    let next = polygon.iter().cycle().skip(1);
    for (&one, &next) in polygon.iter().zip(next) {
        let [d_one, d_next] = [one, next].map(|corner| side.dot(corner));
        if d_one >= 0.0 {
            clipped.push(one);
        }
        if (d_one >= 0.0) != (d_next >= 0.0) {
            clipped.push(one.lerp(next, d_one / (d_one - d_next)));
        }
    }
    clipped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_in_view_is_that_of_the_clipped_polygon() {
        let size = DVec2::new(200.0, 100.0);
        let at = |x: f64, y: f64, w: f64| DVec4::new(x * w, y * w, 0.5, w);
        let inside = [
            at(0.0, 0.0, 1.0),
            at(0.5, 0.0, 2.0),
            at(0.5, 0.5, 3.0),
            at(0.0, 0.5, 1.0),
        ];
        assert!((visible_area(&inside, size) - 50.0 * 25.0).abs() < 1e-9);
        let all = [
            at(-9.0, -9.0, 1.0),
            at(9.0, -9.0, 1.0),
            at(9.0, 9.0, 1.0),
            at(-9.0, 9.0, 1.0),
        ];
        assert!((visible_area(&all, size) - 200.0 * 100.0).abs() < 1e-6);
        let beside = inside.map(|corner| corner + DVec4::new(3.0 * corner.w, 0.0, 0.0, 0.0));
        assert_eq!(visible_area(&beside, size), 0.0);
        let behind = inside.map(|corner| DVec4::new(corner.x, corner.y, 0.5, -corner.w));
        assert_eq!(visible_area(&behind, size), 0.0);
    }
}
