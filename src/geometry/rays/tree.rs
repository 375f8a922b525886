//! A hierarchy of boxes around the triangles that cast, four boxes a node.

use super::triangle::RayTriangle;
use crate::geometry::box_tree;
use crate::scene::Mesh;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use obvhs::bvh2::Bvh2;
use std::time::Instant;

/// How far boxes are inflated, relative to the largest coordinate M of the scene. Where rays meet a slab is found from
/// rounded products with the inverse of their direction, as if the slab had moved by 8 M u, and what a test takes to be
/// within a triangle may lie as far beside it; u = 2^-24. This is twice both.
const INFLATION: f32 = 1.0 / (1 << 19) as f32;

/// Boxes of a node.
const WIDTH: usize = 4;

/// Four boxes and what is in each.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Node {
    /// Smallest x, y, z of each box.
    pub low: [[f32; WIDTH]; 3],
    /// Largest x, y, z of each box.
    pub high: [[f32; WIDTH]; 3],
    /// The number of a node, or [`Self::LEAF`] with 1 less than the number of triangles from bit 28 on and the number
    /// of the first below; from the first 0 on there is nothing.
    pub children: [u32; WIDTH],
}

impl Node {
    /// Marks children that are triangles.
    pub const LEAF: u32 = 1 << 31;
    const FIRST_BITS: u32 = 28;

    /// The triangles of a child, `None` if it is a node.
    #[inline(always)]
    pub fn triangles(child: u32) -> Option<std::ops::Range<usize>> {
        let is_leaf = child & Self::LEAF != 0;
        let first = (child & ((1 << Self::FIRST_BITS) - 1)) as usize;
        let count = ((child >> Self::FIRST_BITS) & 7) as usize + 1;
        is_leaf.then_some(first..first + count)
    }
}

/// The triangles that cast in a scene, and boxes around them.
pub struct RayTree {
    /// The first is the root.
    pub nodes: Vec<Node>,
    /// In the order of leaves.
    pub triangles: Vec<RayTriangle>,
    /// How much larger boxes are than what is in them.
    margin: f32,
    /// How many children of nodes may have to wait at once while a ray is followed.
    pub stack: usize,
    /// Microseconds that it took to build.
    build_us: u64,
}

impl RayTree {
    /// Over the triangles of a mesh that cast.
    pub fn new(mesh: &Mesh) -> Self {
        let begin = Instant::now();
        let scale = mesh.positions.iter().fold(0f32, |scale, position| {
            scale.max(position.abs().max_element())
        });
        let numbers = mesh.casters().flat_map(|object| object.triangles.clone());
        let triangles: Vec<_> = numbers
            .map(|number| RayTriangle::new(mesh, number))
            .collect();
        let margin = scale * INFLATION;
        let around = triangles.iter().map(|triangle| triangle.bounds(margin));
        let boxes: Vec<_> = around.collect();
        let bvh = box_tree::build(&boxes);
        let mut nodes = Vec::with_capacity(bvh.nodes.len() / 2 + 1);
        let stack = widen(&bvh, &mut nodes);
        let in_leaves = |index: &u32| triangles[*index as usize];
        let triangles = bvh.primitive_indices.iter().map(in_leaves).collect();
        Self {
            nodes,
            triangles,
            margin,
            stack,
            build_us: begin.elapsed().as_micros() as u64,
        }
    }

    /// The boxes around its triangles, in their order: smallest and largest x, y, z.
    pub fn boxes(&self) -> Vec<[Vec3; 2]> {
        let bounds = self.triangles.iter().map(|of| of.bounds(self.margin));
        bounds.map(|of| [of.min.into(), of.max.into()]).collect()
    }

    /// What is counted of it, by name.
    pub fn counters(&self) -> Vec<(&'static str, u64)> {
        let bytes = size_of_val(&self.nodes[..]) + size_of_val(&self.triangles[..]);
        vec![
            ("ray_tree_nodes", self.nodes.len() as u64),
            ("ray_tree_bytes", bytes as u64),
            ("ray_tree_us", self.build_us),
        ]
    }
}

/// Makes nodes of four boxes of those of two; gives how many children may wait at once.
fn widen(bvh: &Bvh2, nodes: &mut Vec<Node>) -> usize {
    nodes.push(Node::zeroed());
    if bvh.nodes.is_empty() {
        return 0;
    }
    let mut most_waiting = 0;
    // Which node is made of which, and what waits while it is looked at.
    let mut open = vec![(0, 0, 0)];
    while let Some((wide, narrow, waiting)) = open.pop() {
        let children = children(bvh, narrow);
        let waiting = waiting + children.len();
        most_waiting = most_waiting.max(waiting);
        for (slot, child) in children.into_iter().enumerate() {
            let node = &bvh.nodes[child];
            nodes[wide].children[slot] = if node.is_leaf() {
                Node::LEAF | (node.prim_count - 1) << Node::FIRST_BITS | node.first_index
            } else {
                open.push((nodes.len(), child, waiting - 1));
                nodes.push(Node::zeroed());
                nodes.len() as u32 - 1
            };
            let bounds = node.aabb();
            for axis in 0..3 {
                nodes[wide].low[axis][slot] = bounds.min[axis];
                nodes[wide].high[axis][slot] = bounds.max[axis];
            }
        }
    }
    most_waiting
}

/// Up to four nodes that are all of what is in `narrow`: the largest are opened first.
fn children(bvh: &Bvh2, narrow: usize) -> Vec<usize> {
    let mut children = vec![narrow];
    while children.len() < WIDTH {
        let area = |slot: &usize| bvh.nodes[children[*slot]].aabb().half_area();
        let inner = (0..children.len()).filter(|slot| !bvh.nodes[children[*slot]].is_leaf());
        let Some(largest) = inner.max_by(|x, y| area(x).total_cmp(&area(y))) else {
            break;
        };
        let first = bvh.nodes[children[largest]].first_index as usize;
        children[largest] = first;
        children.push(first + 1);
    }
    children
}
