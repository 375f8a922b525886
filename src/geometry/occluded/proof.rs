//! Proofs that a triangle is occluded.

use super::cone::Cone;
use crate::geometry::near_volume::MARGIN;
use crate::geometry::ray::Ray;
use crate::geometry::{EdgeTriangles, Topology, box_tree};
use crate::scene::Mesh;
use glam::{DVec3, Vec3A, Vec4};
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::fast_stack;
use obvhs::ray::{Ray as BoxRay, RayHit};
use rayon::prelude::*;

/// Beyond an edge: not just one triangle, wound the same way.
const NONE: u32 = u32::MAX;

/// A walk that meets more triangles is given up. On Sponza and the dragon twice as many prove less than a thousandth more.
const MOST_MET: usize = 128;

/// Of a large mesh, some triangles share a box: more boxes take longer to sort than fewer save.
const MOST_BOXES: usize = 1 << 17;

/// Where rays leave a triangle, as weights of its corners; one is tried after another until it keeps away from all edges.
const STARTS: [[f64; 3]; 3] = [[0.343, 0.331, 0.326], [0.52, 0.27, 0.21], [0.19, 0.3, 0.51]];

/// Proves triangles occluded.
pub(super) struct Prover<'a> {
    light: Vec4,
    mesh: &'a Mesh,
    /// For each triangle those beyond its edges from corner 0, 1 and 2, or [`NONE`].
    neighbours: Vec<[u32; 3]>,
    /// All that cast, neighbours in space one after another.
    in_space: Vec<u32>,
    in_a_group: usize,
    /// Over the boxes of groups of so many of them.
    tree: Bvh2,
    margin: f64,
}

/// The triangles that the walks for one triangle have met; few enough to look through.
#[derive(Default)]
pub(super) struct Walks {
    met: Vec<u32>,
    /// Where those of the last walk begin.
    last: usize,
}

impl Walks {
    fn begin(&mut self) {
        self.last = self.met.len();
    }

    fn of_last(&self) -> &[u32] {
        &self.met[self.last..]
    }

    fn meet(&mut self, triangle: u32) {
        if !self.of_last().contains(&triangle) {
            self.met.push(triangle);
        }
    }
}

impl<'a> Prover<'a> {
    pub(super) fn new(
        light: Vec4,
        (mesh, topology, triangles): (&'a Mesh, &Topology, &EdgeTriangles),
    ) -> Self {
        let in_space = in_space(mesh);
        let in_a_group = in_space.len().div_ceil(MOST_BOXES).max(1);
        let around = |group: &[u32]| {
            let vertices = group
                .iter()
                .flat_map(|triangle| mesh.corners(*triangle as usize));
            let points = vertices.map(Vec3A::from);
            points.fold(Aabb::empty(), |mut bounds, point| *bounds.extend(point))
        };
        let boxes: Vec<_> = in_space.par_chunks(in_a_group).map(around).collect();
        let (low, high) = mesh.bounds();
        let largest = low.abs().max(high.abs()).max_element();
        Self {
            light,
            mesh,
            neighbours: neighbours(mesh, topology, triangles),
            in_space,
            in_a_group,
            tree: box_tree::build(&boxes),
            margin: MARGIN * f64::from(largest),
        }
    }

    /// The triangles beyond the edges of one that have just one, wound the same way.
    pub(super) fn neighbours_of(&self, triangle: u32) -> impl Iterator<Item = u32> {
        let all = self.neighbours[triangle as usize].into_iter();
        all.filter(|neighbour| *neighbour != NONE)
    }

    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        let corners = self.mesh.corners(triangle as usize);
        corners.map(|corner| corner.as_dvec3())
    }

    /// Whether there is a proof. Errs to false.
    pub(super) fn is_occluded(&self, triangle: u32, walks: &mut Walks) -> bool {
        let light = self.light.as_dvec4();
        let Some(cone) = Cone::new(self.corners(triangle), light, self.margin) else {
            return false;
        };
        let rays = STARTS.map(|start| cone.ray(start));
        walks.met.clear();
        let mut is_proven = false;
        self.visit_along(&rays[0], |first| {
            let is_pierced = || rays[0].pierces(self.corners(first)) != Some(0);
            if first != triangle && is_pierced() && !walks.met.contains(&first) {
                walks.begin();
                walks.meet(first);
                is_proven = self.is_behind(&cone, &rays, walks);
            }
            !is_proven
        });
        is_proven
    }

    /// Goes on with a walk and says whether what it meets is before all of the triangle.
    fn is_behind(&self, cone: &Cone, rays: &[Ray], walks: &mut Walks) -> bool {
        let mut next = 0;
        while let Some(&triangle) = walks.of_last().get(next) {
            next += 1;
            let corners = self.corners(triangle);
            if walks.of_last().len() > MOST_MET || !cone.holds_before_base(corners) {
                return false;
            }
            let neighbours = self.neighbours[triangle as usize];
            for (side, neighbour) in neighbours.into_iter().enumerate() {
                if cone.may_hold_of_segment([corners[side], corners[(side + 1) % 3]]) {
                    if neighbour == NONE {
                        return false;
                    }
                    walks.meet(neighbour);
                }
            }
        }
        let times_around = |ray: &Ray| {
            let mut times = 0;
            for triangle in walks.of_last() {
                times += ray.pierces(self.corners(*triangle))?;
            }
            Some(times)
        };
        rays.iter()
            .find_map(times_around)
            .is_some_and(|times| times != 0)
    }

    /// Shows triangles that a ray may pierce until `visit` has seen enough. Single precision may miss some.
    fn visit_along(&self, ray: &Ray, mut visit: impl FnMut(u32) -> bool) {
        let end = if ray.ends { 1.0 } else { f32::INFINITY };
        let ray = BoxRay::new(ray.from.as_vec3a(), ray.towards.as_vec3a(), 0.0, end);
        let leaf = |node: &Bvh2Node, _: &mut BoxRay, _: &mut RayHit| {
            let first = node.first_index as usize;
            let groups = &self.tree.primitive_indices[first..first + node.prim_count as usize];
            let of_group = |group: &u32| {
                let start = *group as usize * self.in_a_group;
                &self.in_space[start..self.in_space.len().min(start + self.in_a_group)]
            };
            let mut triangles = groups.iter().flat_map(of_group);
            triangles.all(|triangle| visit(*triangle))
        };
        fast_stack!(u32, (96), self.tree.max_depth, stack, {
            self.tree
                .ray_traverse_dynamic(&mut stack, ray, &mut RayHit::none(), leaf);
        });
    }
}

/// The triangles that cast, along a Morton curve.
fn in_space(mesh: &Mesh) -> Vec<u32> {
    let (low, high) = mesh.bounds();
    let scale = 1024.0 / (high - low).max_element().max(f32::MIN_POSITIVE);
    let code = |triangle: u32| {
        let [a, b, c] = mesh.corners(triangle as usize);
        let cell = ((a + b + c) / 3.0 - low) * scale;
        let bits = cell.to_array().map(|x| spread(x as u32));
        (bits[0] | bits[1] << 1 | bits[2] << 2, triangle)
    };
    let casters = mesh.casters().flat_map(|object| object.triangles.clone());
    let casters: Vec<u32> = casters.collect();
    let mut codes: Vec<_> = casters.into_par_iter().map(code).collect();
    codes.par_sort_unstable();
    codes.into_iter().map(|(_, triangle)| triangle).collect()
}

/// Ten bits, two zeros between each.
fn spread(x: u32) -> u32 {
    let x = x.min(1023);
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}

fn neighbours(mesh: &Mesh, topology: &Topology, triangles: &EdgeTriangles) -> Vec<[u32; 3]> {
    let mut neighbours = vec![[NONE; 3]; mesh.triangles.len()];
    for edge in &topology.edges {
        let &[one, other] = triangles.of(*edge) else {
            continue;
        };
        if one.is_along() == other.is_along() {
            continue;
        }
        for (own, beyond) in [(one, other), (other, one)] {
            let start = if own.is_along() { edge.a } else { edge.b };
            let corners = mesh.triangles[own.triangle()];
            let side = corners.iter().position(|corner| *corner == start);
            if let Some(side) = side {
                neighbours[own.triangle()][side] = beyond.triangle() as u32;
            }
        }
    }
    neighbours
}
