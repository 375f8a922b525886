//! Edges grouped by the planes of their triangles.
//!
//! Around the planes of each edge lies a box in four dimensions; edges are split in halves by the medians of these boxes'
//! centres, down to leaves. A group whose box lies on one side of the light's hyperplane has no silhouette edge, and is
//! skipped whole. Any mesh will do: what has no such box is asked for every light.

use super::planes::{DualLight, Origin, PlaneBox};
use super::{SilhouetteEdge, ask};
use crate::geometry::{Bounds, Topology};
use crate::scene::mesh::Mesh;
use glam::{DVec3, Vec4};
use rayon::prelude::*;

/// Most edges of a leaf.
const LEAF_EDGES: usize = 16;
/// Groups with more edges are split, and searched, by two tasks.
const EDGES_PER_TASK: usize = 8192;

/// The edges of a mesh, in a tree over the planes of their triangles.
pub struct PlaneTree {
    origin: Origin,
    /// In depth-first order.
    nodes: Vec<Node>,
    /// Edges in the order of the leaves, then those that are always asked.
    edges: Vec<u32>,
    /// Where the latter begin.
    always: usize,
    /// The roots of parts that tasks search one by one, and how many nodes each has.
    tasks: Vec<(u32, u32)>,
}

struct Node {
    planes: PlaneBox,
    /// How many nodes it has, with itself: so many to go on if it is skipped.
    size: u32,
    /// Its edges, if it is a leaf; else none.
    first: u32,
    count: u32,
}

/// An edge while the tree is built.
#[derive(Clone, Copy)]
struct Item {
    /// Weighed such that its components are equally important.
    centre: [f32; 4],
    edge: u32,
}

impl PlaneTree {
    /// Builds the tree, on all cores.
    pub fn build(mesh: &Mesh, topology: &Topology) -> Self {
        let Bounds { low, high } = Bounds::of(&mesh.positions);
        let origin = Origin(0.5 * (low + high));
        // Lights are about as far away as the mesh is large, and a normal counts by that much.
        let weights = DVec3::splat(0.5 * (high - low).length()).extend(1.0);
        let boxes: Vec<Option<PlaneBox>> = topology
            .edges
            .par_iter()
            .map(|edge| origin.planes(mesh, topology, *edge))
            .collect();
        let mut items = Vec::with_capacity(boxes.len());
        let mut always = Vec::new();
        for (edge, planes) in (0..).zip(&boxes) {
            match planes {
                Some(planes) => items.push(Item {
                    centre: (weights * planes.centre()).as_vec4().to_array(),
                    edge,
                }),
                None => always.push(edge),
            }
        }
        let nodes = if items.is_empty() {
            Vec::new()
        } else {
            split(&mut items, 0, &boxes)
        };
        let mut edges: Vec<u32> = items.iter().map(|item| item.edge).collect();
        let leaf_edges = edges.len();
        edges.append(&mut always);
        let mut tree = Self {
            origin,
            nodes,
            edges,
            always: leaf_edges,
            tasks: Vec::new(),
        };
        tree.tasks = tree.parts();
        tree
    }

    /// The silhouette, in ascending order of the edges: that of [`brute_force`](super::brute_force), bit for bit.
    pub fn silhouette(&self, mesh: &Mesh, topology: &Topology, light: Vec4) -> Vec<SilhouetteEdge> {
        let dual = &self.origin.light(light);
        let asked = |edges: &[u32], found: &mut Vec<SilhouetteEdge>| {
            found.extend(
                edges
                    .iter()
                    .filter_map(|&edge| ask(mesh, topology, edge, light)),
            );
        };
        let parts = self.tasks.par_iter().map(|&(root, size)| {
            let mut found = Vec::new();
            self.leaves(root..root + size, dual, |edges| asked(edges, &mut found));
            found
        });
        let always = self.edges[self.always..]
            .par_chunks(EDGES_PER_TASK)
            .map(|edges| {
                let mut found = Vec::new();
                asked(edges, &mut found);
                found
            });
        let mut found: Vec<SilhouetteEdge> = parts.chain(always).flatten_iter().collect();
        found.par_sort_unstable();
        found
    }

    /// How many edges are asked for a light.
    pub fn asked(&self, light: Vec4) -> usize {
        let (dual, mut asked) = (self.origin.light(light), self.edges.len() - self.always);
        self.leaves(0..self.nodes.len() as u32, &dual, |edges| {
            asked += edges.len();
        });
        asked
    }

    /// Visits the leaves of a part whose planes may lie on both sides of the light's hyperplane.
    fn leaves(&self, part: std::ops::Range<u32>, light: &DualLight, mut visit: impl FnMut(&[u32])) {
        let mut at = part.start;
        while at < part.end {
            let node = &self.nodes[at as usize];
            if node.planes.is_on_one_side(light) {
                at += node.size;
            } else {
                let first = node.first as usize;
                visit(&self.edges[first..first + node.count as usize]);
                at += 1;
            }
        }
    }

    /// Cuts the tree into parts for tasks.
    fn parts(&self) -> Vec<(u32, u32)> {
        const LEAVES: usize = EDGES_PER_TASK / LEAF_EDGES;
        let mut parts = Vec::new();
        let mut at = 0;
        while let Some(node) = self.nodes.get(at as usize) {
            if node.size as usize <= 2 * LEAVES {
                parts.push((at, node.size));
                at += node.size;
            } else {
                // Its own box is not looked at: what is below will be.
                at += 1;
            }
        }
        parts
    }
}

/// The nodes of a tree over `items`, whose first is to be the edge number `first` of the tree; orders them.
fn split(items: &mut [Item], first: u32, boxes: &[Option<PlaneBox>]) -> Vec<Node> {
    if items.len() <= LEAF_EDGES {
        let planes = items
            .iter()
            .filter_map(|item| boxes[item.edge as usize].as_ref());
        return vec![Node {
            planes: planes.fold(PlaneBox::EMPTY, |all, planes| all.union(planes)),
            size: 1,
            first,
            count: items.len() as u32,
        }];
    }
    let axis = longest_axis(items);
    let middle = items.len() / 2;
    items.select_nth_unstable_by(middle, |one, other| {
        // The edge breaks ties, so that the tree does not depend on how it was partitioned.
        let order = one.centre[axis].total_cmp(&other.centre[axis]);
        order.then(one.edge.cmp(&other.edge))
    });
    let is_large = items.len() > EDGES_PER_TASK;
    let (left, right) = items.split_at_mut(middle);
    let second = first + left.len() as u32;
    let (left, right) = if is_large {
        rayon::join(|| split(left, first, boxes), || split(right, second, boxes))
    } else {
        (split(left, first, boxes), split(right, second, boxes))
    };
    let mut nodes = Vec::with_capacity(1 + left.len() + right.len());
    nodes.push(Node {
        planes: left[0].planes.union(&right[0].planes),
        size: (1 + left.len() + right.len()) as u32,
        first,
        count: 0,
    });
    nodes.extend(left);
    nodes.extend(right);
    nodes
}

fn longest_axis(items: &[Item]) -> usize {
    let centres = items.iter().map(|item| Vec4::from_array(item.centre));
    let (low, high) = centres.fold(
        (Vec4::INFINITY, Vec4::NEG_INFINITY),
        |(low, high), centre| (low.min(centre), high.max(centre)),
    );
    (high - low).max_position()
}
