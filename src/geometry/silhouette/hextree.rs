//! The tree of Wallner 2006 (*Geometry of Real Time Shadows*, section 4).
//!
//! The plane of a triangle, brought to length 1, is a point of the cube from -1 to 1 in four dimensions. An edge of two
//! triangles is then a *dual edge* between two points, and lives in the smallest cube that holds both; a cube has 16
//! children of half its size, down to a fixed depth. A cube on one side of the light's hyperplane is skipped with
//! all that is in it.
//!
//! Unlike the paper's, planes are those of triangles and not of vertices, and an edge that has not two triangles is asked
//! for every light, so that any mesh will do.

use super::edge_block::{self, EdgeBlock};
use super::lanes::{Boxes, DualLight, LANES, OneBox, lanes_of};
use super::large_pages::LargePages;
use super::planes::{Origin, PlaneBox};
use super::{BLOCKS_PER_TASK, EDGES_PER_TASK, Question, SilhouetteEdge, in_parallel};
use crate::geometry::{Edge, Topology};
use crate::scene::mesh::Mesh;
use glam::{BVec4, DVec2, DVec4, Vec4};
use rayon::prelude::*;
use std::ops::Range;

/// The depth of the paper's measurements.
pub const DEPTH: u32 = 4;

/// The edges of a mesh in cubes of dual space.
pub struct Hextree {
    /// The root first; children after their parents.
    cubes: Vec<Cube>,
    /// The edges of all cubes, cube after cube.
    blocks: LargePages<EdgeBlock>,
    /// What no cube can hold.
    always: Vec<u32>,
}

struct Cube {
    children: [Option<u32>; CHILDREN],
    /// Around these.
    boxes: [Boxes; CHILDREN / LANES],
    blocks: Range<u32>,
}

const CHILDREN: usize = 16;

/// A cube while the tree is built.
struct NewCube {
    planes: PlaneBox,
    children: [Option<u32>; CHILDREN],
    edges: Vec<u32>,
}

impl Hextree {
    /// Builds the tree; `depth` is how often cubes are divided at most, [`DEPTH`] in the paper.
    pub fn build(mesh: &Mesh, topology: &Topology, depth: u32) -> Self {
        let of_edge = |edge: &Edge| {
            let [one, other] = Origin::WORLD.pair(mesh, topology, *edge)?;
            Some(one.on_unit_sphere().union(&other.on_unit_sphere()))
        };
        let dual: Vec<Option<PlaneBox>> = topology.edges.par_iter().map(of_edge).collect();
        let mut new = vec![NewCube::new(DVec4::ZERO, 1.0)];
        let mut always = Vec::new();
        for (edge, planes) in (0..).zip(&dual) {
            match planes {
                Some(planes) => insert(&mut new, edge, planes, depth),
                None => always.push(edge),
            }
        }
        let mut first = 0;
        let cubes = new.iter().map(|cube| {
            let blocks = first..first + cube.edges.len().div_ceil(LANES) as u32;
            first = blocks.end;
            let boxes = cube.children.map(|child| {
                child.map_or(OneBox::EMPTY, |child| {
                    OneBox::from(&new[child as usize].planes)
                })
            });
            Cube {
                children: cube.children,
                boxes: [Boxes::new(&boxes[..LANES]), Boxes::new(&boxes[LANES..])],
                blocks,
            }
        });
        let cubes = cubes.collect();
        let chunks = new.par_iter().flat_map(|cube| cube.edges.par_chunks(LANES));
        let blocks = chunks.map(|edges| {
            let of_edge = |&edge: &u32| {
                let own = topology.edges[edge as usize];
                (edge, Origin::WORLD.of_edge(mesh, topology, own))
            };
            let planes: Vec<_> = edges.iter().map(of_edge).collect();
            EdgeBlock::new(planes.iter().map(|(edge, planes)| (*edge, planes)))
        });
        Self {
            cubes,
            blocks: LargePages::new(blocks.collect()),
            always,
        }
    }

    /// Finds the silhouette: that of [`BruteForce`](super::BruteForce), bit for bit, in the order of the tree. What `found`
    /// has is replaced.
    pub fn silhouette(
        &self,
        mesh: &Mesh,
        topology: &Topology,
        light: Vec4,
        found: &mut Vec<SilhouetteEdge>,
    ) {
        let dual = &Origin::WORLD.light(light);
        let question = Question {
            mesh,
            topology,
            light,
        };
        let mut blocks = Vec::new();
        self.visit(0, dual, &mut |of_cube| blocks.extend(of_cube));
        found.clear();
        in_parallel(&blocks, BLOCKS_PER_TASK, found, |_, blocks, found| {
            edge_block::ask(blocks, question, dual, found);
        });
        in_parallel(&self.always, EDGES_PER_TASK, found, |_, edges, found| {
            found.extend(edges.iter().filter_map(|&edge| question.ask(edge)));
        });
    }

    /// How many edges are asked for a light.
    pub fn asked(&self, light: Vec4) -> usize {
        let mut asked = self.always.len();
        self.visit(0, &Origin::WORLD.light(light), &mut |blocks| {
            asked += blocks.iter().flat_map(EdgeBlock::edges).count();
        });
        asked
    }

    fn visit<'a>(&'a self, cube: u32, light: &DualLight, visit: &mut impl FnMut(&'a [EdgeBlock])) {
        let cube = &self.cubes[cube as usize];
        visit(&self.blocks[cube.blocks.start as usize..cube.blocks.end as usize]);
        for (boxes, children) in cube.boxes.iter().zip(cube.children.chunks(LANES)) {
            for lane in lanes_of(boxes.meeting(light)) {
                if let Some(child) = children[lane] {
                    self.visit(child, light, visit);
                }
            }
        }
    }
}

/// Puts an edge into the smallest cube that holds its planes.
fn insert(cubes: &mut Vec<NewCube>, edge: u32, planes: &PlaneBox, depth: u32) {
    let (mut at, mut centre, mut half) = (0, DVec4::ZERO, 1.0);
    for _ in 0..depth {
        let child = planes.low.cmpge(centre);
        if child != planes.high.cmpge(centre) {
            break;
        }
        half *= 0.5;
        centre += half * sign(child);
        let index = child.bitmask() as usize;
        at = match cubes[at].children[index] {
            Some(known) => known as usize,
            None => {
                let new = cubes.len();
                cubes.push(NewCube::new(centre, half));
                cubes[at].children[index] = Some(new as u32);
                new
            }
        };
        let doubt = &mut cubes[at].planes.doubt;
        *doubt = doubt.max(planes.doubt);
    }
    cubes[at].edges.push(edge);
}

impl NewCube {
    fn new(centre: DVec4, half: f64) -> Self {
        Self {
            planes: PlaneBox {
                low: centre - half,
                high: centre + half,
                // Rounding grows with the corners of the cube, too.
                doubt: DVec2::ONE,
            },
            children: [None; CHILDREN],
            edges: Vec::new(),
        }
    }
}

fn sign(is_positive: BVec4) -> DVec4 {
    DVec4::select(is_positive, DVec4::ONE, DVec4::NEG_ONE)
}
