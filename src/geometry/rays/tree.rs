//! A hierarchy of boxes around the triangles that cast, four boxes a node.

use super::triangle::RayTriangle;
use crate::geometry::box_tree;
use crate::scene::Mesh;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use std::time::Instant;

/// How far boxes are inflated, relative to the largest coordinate M of the scene. Where rays meet a slab is found from
/// rounded products with the inverse of their direction, as if the slab had moved by 8 M u, where u = 2^-24; and what a test
/// takes to be within a triangle may lie as far beside it as a few M u by the sine of the angle between edge and light. This
/// is 32 M u, enough for edges that do not point at the light.
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
    /// How many nodes may have to wait at once while a ray is followed.
    pub stack: usize,
    /// Microseconds that it took to build.
    build_us: u64,
}

impl RayTree {
    /// Over the triangles of a mesh that cast.
    pub fn new(mesh: &Mesh) -> Self {
        let begin = Instant::now();
        let triangles = casters(mesh);
        let boxes = boxes(mesh, &triangles);
        let bvh = box_tree::build(&boxes);
        let mut nodes = Vec::with_capacity(bvh.nodes.len() / 2 + 1);
        let stack = widen(&bvh, &mut nodes);
        let in_leaves = |index: &u32| triangles[*index as usize];
        let triangles = bvh.primitive_indices.iter().map(in_leaves).collect();
        Self {
            nodes,
            triangles,
            stack,
            build_us: begin.elapsed().as_micros() as u64,
        }
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

/// The triangles of a mesh that cast, in its order.
pub fn casters(mesh: &Mesh) -> Vec<RayTriangle> {
    let numbers = mesh.casters().flat_map(|object| object.triangles.clone());
    let triangles = numbers.map(|number| RayTriangle::new(mesh, number));
    triangles.collect()
}

/// Boxes around triangles of a mesh, in their order, larger by what rounding may do to rays.
pub fn boxes(mesh: &Mesh, triangles: &[RayTriangle]) -> Vec<Aabb> {
    let largest = |scale: f32, position: &Vec3| scale.max(position.abs().max_element());
    let margin = INFLATION * mesh.positions.iter().fold(0.0, largest);
    let around = triangles.iter().map(|triangle| triangle.bounds(margin));
    around.collect()
}

/// Makes nodes of four boxes of those of two; gives how many of them may wait at once.
fn widen(bvh: &Bvh2, nodes: &mut Vec<Node>) -> usize {
    nodes.push(Node::zeroed());
    if bvh.nodes.is_empty() {
        return 0;
    }
    let mut most_waiting = 1;
    // Which node is made of which, and what waits while it is looked at.
    let mut open = vec![(0, 0, 0)];
    while let Some((wide, narrow, waiting)) = open.pop() {
        let children = children(bvh, narrow);
        let inner = children
            .iter()
            .filter(|child| !bvh.nodes[**child].is_leaf());
        let waiting = waiting + inner.count();
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
