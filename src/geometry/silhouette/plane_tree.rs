//! Edges grouped by the planes of their triangles.
//!
//! Around the planes of each edge lies a box in four dimensions; edges are split in halves, eight by eight, by the
//! centres of these boxes along the longest side, down to blocks of eight edges. A group whose box lies on one side of the
//! light's hyperplane has no silhouette edge, and is skipped whole. Any mesh will do: what has no such box is asked for
//! every light.

use super::edge_block::{self, EdgeBlock};
use super::lanes::{Boxes, DualLight, LANES, OneBox, lanes_of};
use super::large_pages::{AT_A_TIME, LargePages, fetch};
use super::planes::{EdgeKind, EdgePlanes, Origin};
use super::{BLOCKS_PER_TASK, EDGES_PER_TASK, Question, SilhouetteEdge, in_parallel};
use crate::geometry::{Edge, Topology};
use crate::scene::mesh::Mesh;
use glam::Vec4;
use rayon::prelude::*;

/// Groups of more edges are split by two tasks.
const ITEMS_PER_TASK: usize = 8192;

/// The edges of a mesh, in a tree over the planes of their triangles.
pub struct PlaneTree {
    origin: Origin,
    /// The leaves.
    blocks: LargePages<EdgeBlock>,
    /// Boxes around eight blocks, around eight of these, and so on; the last level is one node. Node `i` has nodes
    /// or blocks `8 i` to `8 i + 7` of the level below.
    levels: Vec<LargePages<Boxes>>,
    /// Boundary edges: on the silhouette for nearly every light.
    boundary: LargePages<EdgeBlock>,
    /// All others.
    always: Vec<u32>,
}

/// An edge while the tree is built.
#[derive(Clone, Copy)]
pub(super) struct Item {
    centre: [f32; 4],
    pub(super) edge: u32,
}

impl PlaneTree {
    /// Builds the tree, on all cores.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        let PlaneOrder {
            origin,
            planes,
            items,
            boundary,
            always,
        } = PlaneOrder::new(mesh, topology);
        let of_edges = |edges: &[u32]| {
            let planes_of = |&edge: &u32| (edge, &planes[edge as usize]);
            EdgeBlock::new(edges.iter().map(planes_of))
        };
        let of_items = |items: &[Item]| {
            let planes = items
                .iter()
                .map(|item| (item.edge, &planes[item.edge as usize]));
            let boxes = planes.clone().map(|(_, planes)| OneBox::from(planes));
            (
                EdgeBlock::new(planes),
                boxes.fold(OneBox::EMPTY, OneBox::union),
            )
        };
        let (blocks, boxes): (Vec<_>, Vec<_>) = items.par_chunks(LANES).map(of_items).unzip();
        Self {
            origin,
            levels: levels(boxes),
            blocks: LargePages::new(blocks),
            boundary: LargePages::new(boundary.chunks(LANES).map(of_edges).collect()),
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
        let dual = &self.origin.light(light);
        let question = Question {
            mesh,
            topology,
            light,
        };
        let blocks = self.blocks_to_ask(dual);
        found.clear();
        in_parallel(&blocks, BLOCKS_PER_TASK, found, |_, blocks, found| {
            edge_block::ask(blocks, question, dual, found);
        });
        in_parallel(
            &self.boundary,
            BLOCKS_PER_TASK,
            found,
            |_, blocks, found| {
                edge_block::ask_boundary(blocks, question, dual, found);
            },
        );
        in_parallel(&self.always, EDGES_PER_TASK, found, |_, edges, found| {
            found.extend(edges.iter().filter_map(|&edge| question.ask(edge)));
        });
    }

    /// How many edges are asked for a light.
    pub fn asked(&self, light: Vec4) -> usize {
        let mut asked = 0;
        self.for_each_asked(light, |_| asked += 1);
        asked
    }

    /// The edges that are asked for a light: all on the silhouette, and those that groups do not tell from these.
    pub fn for_each_asked(&self, light: Vec4, mut visit: impl FnMut(u32)) {
        let blocks = self.blocks_to_ask(&self.origin.light(light));
        for blocks in blocks.chunks(AT_A_TIME) {
            fetch(blocks.iter().copied());
            let in_tree = blocks.iter().flat_map(|block| block.edges());
            in_tree.for_each(&mut visit);
        }
        let boundary = self.boundary.iter().flat_map(EdgeBlock::edges);
        boundary.for_each(&mut visit);
        self.always.iter().copied().for_each(visit);
    }

    /// The blocks whose planes may lie on both sides of the light's hyperplane.
    fn blocks_to_ask(&self, light: &DualLight) -> Vec<&EdgeBlock> {
        let (mut nodes, mut below) = (vec![0], Vec::new());
        for level in self.levels.iter().rev() {
            for nodes in nodes.chunks(AT_A_TIME) {
                // Lanes without a box seem to meet every light.
                let boxes = nodes
                    .iter()
                    .filter_map(|&node| Some((node, level.get(node as usize)?)));
                fetch(boxes.clone().map(|(_, boxes)| boxes));
                for (node, boxes) in boxes {
                    let lanes = lanes_of(boxes.meeting(light));
                    below.extend(lanes.map(|lane| LANES as u32 * node + lane as u32));
                }
            }
            nodes.clear();
            std::mem::swap(&mut nodes, &mut below);
        }
        let blocks = nodes.iter();
        blocks
            .filter_map(|&block| self.blocks.get(block as usize))
            .collect()
    }
}

/// The edges of a mesh, ordered by the planes of their triangles.
pub(super) struct PlaneOrder {
    pub(super) origin: Origin,
    /// Of each edge.
    pub(super) planes: Vec<EdgePlanes>,
    /// Edges with a box around their planes, near in dual space where they are near here.
    pub(super) items: Vec<Item>,
    /// See [`PlaneTree`].
    boundary: Vec<u32>,
    always: Vec<u32>,
}

impl PlaneOrder {
    /// Finds it, on all cores.
    pub(super) fn new(mesh: &Mesh, topology: &Topology) -> Self {
        let origin = Origin::of(mesh);
        let of_edge = |edge: &Edge| origin.of_edge(mesh, topology, *edge);
        let planes: Vec<EdgePlanes> = topology.edges.par_iter().map(of_edge).collect();
        let (mut items, mut boundary, mut always) = (Vec::new(), Vec::new(), Vec::new());
        items.reserve(planes.len());
        for (planes, edge) in planes.iter().zip(0..) {
            match planes.kind {
                EdgeKind::Pair | EdgeKind::Box => items.push(Item {
                    centre: origin.centre(planes).to_array(),
                    edge,
                }),
                EdgeKind::Boundary => boundary.push(edge),
                EdgeKind::Unknown => always.push(edge),
            }
        }
        order(&mut items);
        Self {
            origin,
            planes,
            items,
            boundary,
            always,
        }
    }

    /// The edges without such a box.
    pub(super) fn others(&self) -> impl Iterator<Item = u32> {
        self.boundary.iter().chain(&self.always).copied()
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
        one.centre[axis].total_cmp(&other.centre[axis])
    });
    let is_large = items.len() > ITEMS_PER_TASK;
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
fn levels(mut boxes: Vec<OneBox>) -> Vec<LargePages<Boxes>> {
    let mut levels = Vec::new();
    while !boxes.is_empty() {
        let level = boxes.par_chunks(LANES).map(Boxes::new).collect();
        levels.push(LargePages::new(level));
        if boxes.len() <= LANES {
            break;
        }
        let around = |boxes: &[OneBox]| boxes.iter().copied().fold(OneBox::EMPTY, OneBox::union);
        boxes = boxes.par_chunks(LANES).map(around).collect();
    }
    levels
}
