//! In how many shadow volumes the near rectangle lies, object by object: where z-pass may begin to count.
//!
//! Counting z-pass begins at the near plane, so it misses the volumes that are entered before it. Where no side quad of an
//! object's volume and none of its triangles meets the near rectangle, all of the rectangle is in the same number of
//! them, which one ray towards the light counts: for each triangle that it pierces, one. z-pass that begins with this
//! number is right wherever the eye is, and needs no caps. (Crow 1977 begins with the number of volumes around the eye, which
//! is one point; Everitt and Kilgard 2002, section 5.4, ask for the whole near rectangle when the number is 0.)

use super::open_edges::winding;
use super::ray::Ray;
use super::{Bounds, Casting, Determinism, Edge, EdgeTriangles, NearVolume, Topology};
use crate::scene::Mesh;
use glam::Vec4;
use rayon::prelude::*;
use std::ops::Range;

/// So many edges or triangles, one after another in the mesh, have a box around them.
const IN_A_GROUP: usize = 64;

/// In how many volumes of an object the near rectangle lies.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NearCount {
    /// Of all triangles, or of those that face the light, whichever casts.
    pub of_casting: i32,
    /// Of all triangles, each with the sign of its winding: what S of [`super::open_edges`] is here.
    pub of_windings: i32,
}

/// Points of the near rectangle that rays start from: parts of its sides. One after another is tried until a ray keeps away
/// from all edges; no edge of a regular mesh goes through all of them.
const STARTS: [[f64; 2]; 6] = [
    [0.503, 0.491],
    [0.287, 0.631],
    [0.713, 0.347],
    [0.391, 0.173],
    [0.847, 0.789],
    [0.139, 0.911],
];

/// Boxes around edges and triangles, by which the few near a ray are found.
pub struct NearCounts {
    objects: Vec<ObjectGroups>,
}

/// The groups of one object that casts.
struct ObjectGroups {
    edges: Groups,
    triangles: Groups,
}

/// Consecutive elements, [`IN_A_GROUP`] to a box.
struct Groups {
    all: Range<usize>,
    boxes: Vec<Bounds>,
}

impl Groups {
    fn new(all: Range<usize>, bounds: impl Fn(Range<usize>) -> Bounds + Sync) -> Self {
        let starts = all.clone().into_par_iter().step_by(IN_A_GROUP);
        let boxes = starts.map(|start| bounds(start..all.end.min(start + IN_A_GROUP)));
        Self {
            boxes: boxes.collect(),
            all,
        }
    }

    /// Those in groups that may have something in the near volume.
    fn near<'a>(&'a self, volume: &'a NearVolume) -> impl Iterator<Item = usize> + 'a {
        let starts = self.all.clone().step_by(IN_A_GROUP);
        let groups = starts.zip(&self.boxes);
        groups
            .filter(|(_, bounds)| volume.may_meet(**bounds))
            .flat_map(|(start, _)| start..self.all.end.min(start + IN_A_GROUP))
    }
}

impl NearCounts {
    /// For the objects of a mesh that cast.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        let at = |vertex: u32| &mesh.positions[vertex as usize];
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let casters = objects.filter(|(object, _)| object.casts_shadow);
        let groups = casters.map(|(object, edges)| ObjectGroups {
            edges: Groups::new(edges.start as usize..edges.end as usize, |edges| {
                let edges = topology.edges[edges].iter();
                Bounds::of(edges.flat_map(|edge| [at(edge.a), at(edge.b)]))
            }),
            triangles: Groups::new(object.triangle_range(), |triangles| {
                let vertices = mesh.triangles[triangles].iter().flatten();
                Bounds::of(vertices.map(|vertex| at(*vertex)))
            }),
        });
        Self {
            objects: groups.collect(),
        }
    }

    /// In how many volumes of the object that casts with this number, in drawing order, all of the near rectangle lies;
    /// `None` where not all of it may lie in the same ones. Which way the `triangles` of edges are wound matters where
    /// not all cast. A triangle whose facing is against its own winding seen
    /// from the light, by rounding, counts as its volume does.
    pub fn count(
        &self,
        (mesh, topology, triangles): (&Mesh, &Topology, Option<&EdgeTriangles>),
        caster: usize,
        near: &NearRay<'_>,
    ) -> Option<NearCount> {
        let groups = &self.objects[caster];
        let at = |vertex: u32| mesh.positions[vertex as usize];
        let facing = |a, b, c| near.determinism.facing(at(a), at(b), at(c), near.light);
        // Whether it has side quads.
        let is_drawn = |edge: Edge| {
            let opposites = topology.opposites_of(edge).iter();
            let facings = opposites.map(|&o| facing(edge.a, edge.b, o));
            let Some(triangles) = triangles.filter(|_| near.casting != Casting::All) else {
                return facings.sum::<i32>() != 0;
            };
            let windings = triangles.of(edge).iter().copied().map(winding);
            let facing_light = facings.zip(windings.clone()).filter(|(f, w)| f == w);
            let open: i32 = windings.sum();
            facing_light.map(|(facing, _)| facing).sum::<i32>() != 0
                || open != 0 && near.casting == Casting::EachSide
        };
        let crosses = |edge: usize| {
            let edge = topology.edges[edge];
            let ends = [edge.a, edge.b].map(|vertex| at(vertex).as_dvec3());
            near.volume.may_meet_segment(ends) && is_drawn(edge)
        };
        if groups.edges.near(near.volume).any(crosses) {
            return None;
        }
        let candidates: Vec<_> = groups.triangles.near(near.volume).collect();
        let corners = |triangle: usize| mesh.corners(triangle).map(|corner| corner.as_dvec3());
        let meets = |triangle: &usize| near.volume.may_meet_near_rectangle(corners(*triangle));
        if candidates.iter().any(meets) {
            return None;
        }
        let from_start = |start| {
            let ray = near.ray(start);
            let mut count = NearCount::default();
            for &triangle in &candidates {
                let [a, b, c] = mesh.triangles[triangle];
                if a == b || b == c || c == a {
                    continue;
                }
                let pierced = ray.pierces(corners(triangle))?;
                if pierced != 0 {
                    count.of_windings += pierced;
                    count.of_casting += pierced
                        * match (facing(a, b, c), near.casting) {
                            (-1, Casting::LightFacing | Casting::EachSide) => 0,
                            (facing, _) => facing,
                        };
                }
            }
            Some(count)
        };
        STARTS.into_iter().find_map(from_start)
    }
}

/// What is asked of all objects in a frame.
pub struct NearRay<'a> {
    /// The near volume of the frame.
    pub volume: &'a NearVolume,
    /// The light.
    pub light: Vec4,
    /// How the object casts.
    pub casting: Casting,
    /// How facings are found.
    pub determinism: Determinism,
}

impl NearRay<'_> {
    fn ray(&self, [right, up]: [f64; 2]) -> Ray {
        let [corner, along, _, across] = self.volume.near_rectangle();
        let from = corner + (along - corner) * right + (across - corner) * up;
        let light = self.light.as_dvec4();
        Ray {
            from,
            towards: light.truncate() - from * light.w,
            ends: light.w != 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Part;
    use glam::{DVec3, Vec3};

    /// The count of an object of these triangles for a near rectangle of 0.2 × 0.2 around a point, under a lamp at
    /// height 10 above the origin.
    fn count(triangles: &[[Vec3; 3]], near: DVec3, casting: Casting) -> Option<NearCount> {
        let mesh: Mesh = [Part::of_triangles("one", triangles)].into_iter().collect();
        let topology = Topology::build(&mesh);
        let edge_triangles = EdgeTriangles::build(&mesh, &topology);
        let light = Vec4::new(0.0, 10.0, 0.0, 1.0);
        let corners = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)]
            .map(|(x, y)| near + DVec3::new(x, y, 0.0));
        let ray = NearRay {
            volume: &NearVolume::new(corners, light),
            light,
            casting,
            determinism: Determinism::default(),
        };
        let counts = NearCounts::build(&mesh, &topology);
        counts.count((&mesh, &topology, Some(&edge_triangles)), 0, &ray)
    }

    /// A level square of side 8 at a height, of two triangles that face up, or down.
    fn square(height: f32, up: bool) -> Vec<[Vec3; 3]> {
        let at = |x: f32, z: f32| Vec3::new(4.0 * x, height, 4.0 * z);
        let [a, b, c, d] = [at(-1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)];
        if up {
            vec![[a, b, c], [a, c, d]]
        } else {
            vec![[a, c, b], [a, d, c]]
        }
    }

    #[test]
    fn below_a_square_is_one_volume_below_its_edge_is_no_number_and_beside_it_none() {
        for up in [true, false] {
            let square = square(5.0, up);
            let all = |near| count(&square, near, Casting::All).map(|count| count.of_casting);
            // The fold between the two triangles is on the way, too.
            assert_eq!(all(DVec3::new(0.3, 1.0, 0.3)), Some(1));
            assert_eq!(all(DVec3::new(7.2, 1.0, 0.0)), None);
            assert_eq!(all(DVec3::new(40.0, 1.0, 0.0)), Some(0));
            assert_eq!(all(DVec3::new(0.3, 7.0, 0.3)), Some(0), "above it");
            assert_eq!(all(DVec3::new(0.3, 5.0, 0.3)), None, "cut by it");
        }
    }

    #[test]
    fn sides_are_told_apart_and_sheets_add_up() {
        let near = DVec3::new(0.3, 1.0, 0.3);
        let sheets = [square(5.0, true), square(6.0, false), square(7.0, false)].concat();
        let of = |casting| count(&sheets, near, casting);
        let expected = |of_casting| {
            Some(NearCount {
                of_casting,
                of_windings: -1,
            })
        };
        assert_eq!(of(Casting::All), expected(3));
        assert_eq!(of(Casting::EachSide), expected(1));
        assert_eq!(of(Casting::LightFacing), expected(1));
    }
}
