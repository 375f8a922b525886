//! Edges grouped by the planes of their triangles.
//!
//! Around the planes of each edge lies a box in four dimensions; edges are split in halves, eight by eight, by the
//! centres of these boxes along the longest side, down to blocks of eight edges. A group whose box lies on one side of the
//! light's hyperplane has no silhouette edge, and is skipped whole. Any mesh will do: what has no such box is asked for
//! every light.

use super::edge_block::EdgeBlock;
use super::lanes::{Boxes, DualLight, LANES, OneBox, lanes_of};
use super::planes::Origin;
use super::{Question, SilhouetteEdge, in_parallel};
use crate::geometry::Topology;
use crate::scene::mesh::Mesh;
use glam::Vec4;
use rayon::prelude::*;

/// Groups of more edges are split by two tasks.
const EDGES_PER_TASK: usize = 8192;
/// The nodes of one level are shared out among tasks if there are so many.
const NODES_TO_SHARE: usize = 64;

/// The edges of a mesh, in a tree over the planes of their triangles.
pub struct PlaneTree {
    origin: Origin,
    /// The leaves.
    blocks: Vec<EdgeBlock>,
    /// Boxes around eight blocks, around eight of these, and so on; the last level is one node. Node `i` has nodes
    /// or blocks `8 i` to `8 i + 7` of the level below.
    levels: Vec<Vec<Boxes>>,
    /// Boundary edges: on the silhouette for nearly every light.
    boundary: Vec<EdgeBlock>,
    /// All others.
    always: Vec<u32>,
}

/// An edge while the tree is built.
#[derive(Clone, Copy)]
struct Item {
    centre: [f32; 4],
    edge: u32,
}

/// Edges by how they are asked.
#[derive(Default)]
struct Sorted {
    items: Vec<Item>,
    boundary: Vec<u32>,
    always: Vec<u32>,
}

impl PlaneTree {
    /// Builds the tree, on all cores.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        let origin = Origin::of(mesh);
        let Sorted {
            mut items,
            boundary,
            always,
        } = Sorted::new(mesh, topology, origin);
        order(&mut items);
        let (blocks, boxes): (Vec<_>, Vec<_>) = items
            .par_chunks(LANES)
            .map(|items| {
                let edges = items.iter().map(|item| item.edge);
                EdgeBlock::new(mesh, topology, origin, edges)
            })
            .unzip();
        let boundary = boundary.par_chunks(LANES).map(|edges| {
            EdgeBlock::of_boundary(edges.iter().map(|&number| {
                let edge = topology.edges[number as usize];
                let opposite = topology.opposites_of(edge)[0];
                (number, origin.plane(mesh, edge, opposite))
            }))
        });
        Self {
            origin,
            levels: levels(boxes),
            blocks,
            boundary: boundary.collect(),
            always,
        }
    }

    /// The silhouette: that of [`BruteForce`](super::BruteForce), bit for bit, in the order of the tree.
    pub fn silhouette(&self, mesh: &Mesh, topology: &Topology, light: Vec4) -> Vec<SilhouetteEdge> {
        let dual = &self.origin.light(light);
        let question = Question {
            mesh,
            topology,
            light,
        };
        let shared = self.shared_level();
        let nodes: Vec<_> = (0..self.levels.get(shared).map_or(0, Vec::len)).collect();
        let mut found = in_parallel(&nodes, NODES_TO_SHARE / 8, |&node, found| {
            self.visit(shared, node, dual, &mut |block| {
                block.ask(question, dual, found)
            });
        });
        found.append(&mut in_parallel(&self.boundary, 256, |block, found| {
            block.ask_boundary(question, dual, found);
        }));
        found.append(&mut in_parallel(&self.always, 1024, |&edge, found| {
            found.extend(question.ask(edge));
        }));
        found
    }

    /// How many edges are asked for a light.
    pub fn asked(&self, light: Vec4) -> usize {
        let boundary = self.boundary.iter().flat_map(EdgeBlock::edges).count();
        let mut asked = self.always.len() + boundary;
        if let Some(top) = self.levels.len().checked_sub(1) {
            self.visit(top, 0, &self.origin.light(light), &mut |block| {
                asked += block.edges().count();
            });
        }
        asked
    }

    /// The highest level that has enough nodes for all tasks.
    fn shared_level(&self) -> usize {
        let has_enough = |level: &Vec<Boxes>| level.len() >= NODES_TO_SHARE;
        self.levels
            .iter()
            .rposition(has_enough)
            .unwrap_or_else(|| self.levels.len().saturating_sub(1))
    }

    /// Visits the blocks below a node whose planes may lie on both sides of the light's hyperplane.
    fn visit(
        &self,
        level: usize,
        node: usize,
        light: &DualLight,
        visit: &mut impl FnMut(&EdgeBlock),
    ) {
        let first = LANES * node;
        for lane in lanes_of(self.levels[level][node].meeting(light)) {
            if level > 0 {
                if first + lane < self.levels[level - 1].len() {
                    self.visit(level - 1, first + lane, light, visit);
                }
            } else if let Some(block) = self.blocks.get(first + lane) {
                visit(block);
            }
        }
    }
}

impl Sorted {
    fn new(mesh: &Mesh, topology: &Topology, origin: Origin) -> Self {
        let of_task = |task: usize| {
            let mut sorted = Self::default();
            let edges = topology.edges.iter().zip(0..).skip(task * EDGES_PER_TASK);
            for (&edge, number) in edges.take(EDGES_PER_TASK) {
                match origin.planes(mesh, topology, edge) {
                    Some(planes) => sorted.items.push(Item {
                        centre: origin.centre(&planes).to_array(),
                        edge: number,
                    }),
                    None if edge.opposite_count == 1 => sorted.boundary.push(number),
                    None => sorted.always.push(number),
                }
            }
            sorted
        };
        let tasks = topology.edges.len().div_ceil(EDGES_PER_TASK);
        let tasks: Vec<Self> = (0..tasks).into_par_iter().map(of_task).collect();
        let mut all = Self::default();
        for task in tasks {
            all.items.extend(task.items);
            all.boundary.extend(task.boundary);
            all.always.extend(task.always);
        }
        all
    }
}

/// Orders edges such that those of a block are together, blocks of a node, and so on up: halves as the levels have them.
fn order(items: &mut [Item]) {
    let blocks = items.len().div_ceil(LANES);
    if blocks <= 1 {
        return;
    }
    let axis = longest_axis(items);
    // The first half has a whole number of nodes of every level that it reaches.
    let middle = LANES * blocks.next_power_of_two() / 2;
    items.select_nth_unstable_by(middle, |one, other| {
        // The edge breaks ties, so that the tree does not depend on how it was partitioned.
        let order = one.centre[axis].total_cmp(&other.centre[axis]);
        order.then(one.edge.cmp(&other.edge))
    });
    let is_large = items.len() > EDGES_PER_TASK;
    let (left, right) = items.split_at_mut(middle);
    if is_large {
        rayon::join(|| order(left), || order(right));
    } else {
        order(left);
        order(right);
    }
}

fn longest_axis(items: &[Item]) -> usize {
    let centres = items.iter().map(|item| Vec4::from_array(item.centre));
    let (low, high) = centres.fold(
        (Vec4::INFINITY, Vec4::NEG_INFINITY),
        |(low, high), centre| (low.min(centre), high.max(centre)),
    );
    (high - low).max_position()
}

/// The levels over blocks with these boxes.
fn levels(mut boxes: Vec<OneBox>) -> Vec<Vec<Boxes>> {
    let mut levels = Vec::new();
    while !boxes.is_empty() {
        levels.push(boxes.par_chunks(LANES).map(Boxes::new).collect::<Vec<_>>());
        if boxes.len() <= LANES {
            break;
        }
        let around = |boxes: &[OneBox]| boxes.iter().copied().fold(OneBox::EMPTY, OneBox::union);
        boxes = boxes.par_chunks(LANES).map(around).collect();
    }
    levels
}
