//! The tree of Wallner 2006 (*Geometry of Real Time Shadows*, section 2.1).
//!
//! The plane of a triangle, brought to length 1, is a point of the cube from -1 to 1 in four dimensions. An edge of two
//! triangles is then a *dual edge* between two points, and lives in the smallest cube that holds both; a cube has 16
//! children of half its size, down to a fixed depth. A cube on one side of the light's hyperplane is skipped with
//! all that is in it.
//!
//! Unlike the paper's, planes are those of triangles and not of vertices, and an edge that has not two triangles is asked
//! for every light, so that any mesh will do.

use super::planes::{DualLight, Origin, PlaneBox};
use super::{SilhouetteEdge, ask};
use crate::geometry::{Edge, Topology};
use crate::scene::mesh::Mesh;
use glam::{BVec4, DVec3, DVec4, Vec4};
use rayon::prelude::*;

/// The depth of the paper's measurements.
pub const DEPTH: u32 = 4;

/// The edges of a mesh in cubes of dual space.
pub struct Hextree {
    /// The root first; children after their parents.
    cubes: Vec<Cube>,
    /// What no cube can hold.
    always: Vec<u32>,
}

struct Cube {
    planes: PlaneBox,
    children: [Option<u32>; 16],
    edges: Vec<u32>,
}

impl Hextree {
    /// Builds the tree; `depth` is how often cubes are divided at most, [`DEPTH`] in the paper.
    pub fn build(mesh: &Mesh, topology: &Topology, depth: u32) -> Self {
        let of_edge = |edge: &Edge| {
            let [one, other] = Origin(DVec3::ZERO).pair(mesh, topology, *edge)?;
            Some(one.on_unit_sphere().union(&other.on_unit_sphere()))
        };
        let dual: Vec<Option<PlaneBox>> = topology.edges.par_iter().map(of_edge).collect();
        let mut tree = Self {
            cubes: vec![Cube::new(DVec4::ZERO, 1.0)],
            always: Vec::new(),
        };
        for (edge, planes) in (0..).zip(&dual) {
            match planes {
                Some(planes) => tree.insert(edge, planes, depth),
                None => tree.always.push(edge),
            }
        }
        tree
    }

    fn insert(&mut self, edge: u32, planes: &PlaneBox, depth: u32) {
        let (mut at, mut centre, mut half) = (0, DVec4::ZERO, 1.0);
        for _ in 0..depth {
            self.cubes[at].planes.doubt = self.cubes[at].planes.doubt.max(planes.doubt);
            let child = planes.low.cmpge(centre);
            if child != planes.high.cmpge(centre) {
                break;
            }
            half *= 0.5;
            centre += half * sign(child);
            let index = child.bitmask() as usize;
            at = match self.cubes[at].children[index] {
                Some(known) => known as usize,
                None => {
                    let new = self.cubes.len();
                    self.cubes.push(Cube::new(centre, half));
                    self.cubes[at].children[index] = Some(new as u32);
                    new
                }
            };
        }
        let cube = &mut self.cubes[at];
        cube.planes.doubt = cube.planes.doubt.max(planes.doubt);
        cube.edges.push(edge);
    }

    /// The silhouette, in ascending order of the edges: that of [`brute_force`](super::brute_force), bit for bit.
    pub fn silhouette(&self, mesh: &Mesh, topology: &Topology, light: Vec4) -> Vec<SilhouetteEdge> {
        let mut lists = vec![self.always.as_slice()];
        self.visit(0, &Origin(DVec3::ZERO).light(light), &mut |edges| {
            lists.push(edges);
        });
        let chunks = lists
            .par_iter()
            .flat_map_iter(|list| list.chunks(super::EDGES_PER_TASK));
        let found = chunks.flat_map_iter(|edges| {
            edges
                .iter()
                .filter_map(|&edge| ask(mesh, topology, edge, light))
        });
        let mut found: Vec<SilhouetteEdge> = found.collect();
        found.par_sort_unstable();
        found
    }

    /// How many edges are asked for a light.
    pub fn asked(&self, light: Vec4) -> usize {
        let mut asked = self.always.len();
        self.visit(0, &Origin(DVec3::ZERO).light(light), &mut |edges| {
            asked += edges.len();
        });
        asked
    }

    fn visit<'a>(&'a self, cube: u32, light: &DualLight, visit: &mut impl FnMut(&'a [u32])) {
        let cube = &self.cubes[cube as usize];
        if !cube.planes.is_on_one_side(light) {
            visit(&cube.edges);
            for child in cube.children.iter().flatten() {
                self.visit(*child, light, visit);
            }
        }
    }
}

impl Cube {
    fn new(centre: DVec4, half: f64) -> Self {
        Self {
            planes: PlaneBox {
                low: centre - half,
                high: centre + half,
                doubt: DVec4::ZERO,
            },
            children: [None; 16],
            edges: Vec::new(),
        }
    }
}

fn sign(is_positive: BVec4) -> DVec4 {
    DVec4::select(is_positive, DVec4::ONE, DVec4::NEG_ONE)
}
