//! A binary tree of boxes over objects.

use crate::geometry::{Bounds, box_tree};
use glam::Vec3A;
use obvhs::aabb::Aabb;

/// A box and what is in it.
#[derive(Debug, Clone)]
pub struct BoxNode {
    /// Around all that is below.
    pub bounds: Bounds,
    /// Two nodes, or `None` for a leaf.
    pub children: Option<[u32; 2]>,
    /// The objects of all leaves below, in [`BoxTree::objects`].
    pub(super) objects: std::ops::Range<u32>,
}

/// A tree over the boxes of objects. Those without a box are in none of its leaves.
#[derive(Debug, Clone, Default)]
pub struct BoxTree {
    /// The root is the first; parents come before their children.
    pub nodes: Vec<BoxNode>,
    /// Objects, leaf after leaf.
    objects: Vec<u32>,
}

impl BoxTree {
    /// Over boxes, an object each.
    pub fn new(objects: &[Bounds]) -> Self {
        let full = (0..).zip(objects).filter(|(_, bounds)| !bounds.is_empty());
        let (numbers, boxes): (Vec<u32>, Vec<Bounds>) =
            full.map(|(n, bounds)| (n, *bounds)).unzip();
        // Vertices have 32 bits, so the conversion is exact.
        let aabb = |bounds: &Bounds| Aabb::new(bounds.low.as_vec3a(), bounds.high.as_vec3a());
        let bvh = box_tree::build(&boxes.iter().map(aabb).collect::<Vec<_>>());
        let in_leaves = bvh.primitive_indices.iter();
        let mut tree = Self {
            nodes: Vec::with_capacity(bvh.nodes.len()),
            objects: in_leaves.map(|at| numbers[*at as usize]).collect(),
        };
        for node in &bvh.nodes {
            let bounds = node.aabb();
            let corner = |corner: Vec3A| corner.as_dvec3();
            let first = node.first_index;
            tree.nodes.push(BoxNode {
                bounds: Bounds {
                    low: corner(bounds.min),
                    high: corner(bounds.max),
                },
                children: (!node.is_leaf()).then_some([first, first + 1]),
                objects: if node.is_leaf() {
                    first..first + node.prim_count
                } else {
                    0..0
                },
            });
        }
        tree.find_objects();
        tree
    }

    /// Those of inner nodes are those of their children, which follow each other.
    fn find_objects(&mut self) {
        for number in (0..self.nodes.len()).rev() {
            if let Some(children) = self.nodes[number].children {
                let [one, other] = children.map(|child| self.nodes[child as usize].objects.clone());
                self.nodes[number].objects = one.start.min(other.start)..one.end.max(other.end);
            }
        }
    }

    /// The objects below a node.
    pub fn objects(&self, node: u32) -> &[u32] {
        let range = &self.nodes[node as usize].objects;
        &self.objects[range.start as usize..range.end as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn each_object_with_a_box_is_in_one_leaf_within_its_box() {
        let at = |i: u32| {
            let low = DVec3::new(
                f64::from(i * 7 % 31),
                f64::from(i % 5),
                f64::from(i * 3 % 17),
            );
            let high = low + DVec3::splat(f64::from(1 + i % 3));
            if i % 10 == 9 {
                Bounds::EMPTY
            } else {
                Bounds { low, high }
            }
        };
        let boxes: Vec<_> = (0..100).map(at).collect();
        let tree = BoxTree::new(&boxes);
        let mut all = tree.objects(0).to_vec();
        all.sort_unstable();
        let full = (0..100).filter(|i| !boxes[*i as usize].is_empty());
        assert!(all.into_iter().eq(full));
        for (number, node) in (0..).zip(&tree.nodes) {
            let mut own = 0;
            for object in tree.objects(number) {
                assert_eq!(node.bounds.union(boxes[*object as usize]), node.bounds);
                own += 1;
            }
            let below = node.children.iter().flatten().map(|child| {
                assert!(*child > number);
                tree.objects(*child).len()
            });
            let below: usize = below.sum();
            assert!(node.children.is_none() || below == own);
        }
    }

    #[test]
    fn nothing_makes_no_tree() {
        assert!(BoxTree::new(&[]).nodes.is_empty());
        assert!(BoxTree::new(&[Bounds::EMPTY]).nodes.is_empty());
    }
}
