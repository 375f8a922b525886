//! Builds the hierarchy from above: sorted into bins by the surface area heuristic (Wald 2007), and at worst
//! in halves.
//!
//! Builders that merge boxes from below take as many rounds as there are boxes where all costs are equal or
//! rise along the row: boxes that coincide, or that are nested in each other.

use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;

const BINS: usize = 16;

/// Most triangles of a leaf.
const MAX_IN_LEAF: usize = 4;

/// Below so many splits by cost, which may be as uneven as the boxes are, all further ones are in halves.
const MAX_UNEVEN_DEPTH: usize = 48;

/// A box and the number of what is in it.
#[derive(Clone, Copy)]
struct Boxed {
    bounds: Aabb,
    index: u32,
}

impl Boxed {
    fn middle(&self) -> Vec3A {
        (self.bounds.min + self.bounds.max) * 0.5
    }
}

/// The hierarchy over these boxes. It takes at most linear time times the depth, and this is at most
/// [`MAX_UNEVEN_DEPTH`] and the logarithm of the number of boxes.
pub fn build(boxes: &[Aabb]) -> Bvh2 {
    let mut bvh = Bvh2::default();
    if boxes.is_empty() {
        bvh.max_depth = 1;
        return bvh;
    }
    let boxed = |(&bounds, index)| Boxed { bounds, index };
    let mut boxed: Vec<Boxed> = boxes.iter().zip(0..).map(boxed).collect();
    bvh.nodes.push(Bvh2Node::default());
    let mut open = vec![(0, 0..boxed.len(), 1)];
    while let Some((node, range, depth)) = open.pop() {
        let first = range.start;
        let own = &mut boxed[range];
        let bounds = around(own);
        bvh.max_depth = bvh.max_depth.max(depth);
        let Some(left) = split(own, bounds, depth) else {
            bvh.nodes[node] = Bvh2Node::new(bounds, own.len() as u32, first as u32);
            continue;
        };
        let children = bvh.nodes.len();
        bvh.nodes[node] = Bvh2Node::new(bounds, 0, children as u32);
        bvh.nodes.extend([Bvh2Node::default(); 2]);
        open.push((children, first..first + left, depth + 1));
        open.push((children + 1, first + left..first + own.len(), depth + 1));
    }
    bvh.primitive_indices = boxed.iter().map(|boxed| boxed.index).collect();
    bvh
}

fn around(boxed: &[Boxed]) -> Aabb {
    let bounds = boxed.iter().map(|boxed| boxed.bounds);
    bounds.fold(Aabb::empty(), |one, other| one.union(&other))
}

/// Sorts boxes into two groups and says how many come first. `None` if they make a leaf.
fn split(boxed: &mut [Boxed], bounds: Aabb, depth: usize) -> Option<usize> {
    let count = boxed.len();
    if count == 1 {
        return None;
    }
    let middles = boxed.iter().map(Boxed::middle);
    let middles = middles.fold(Aabb::empty(), |bounds, p| bounds.union(&Aabb::new(p, p)));
    let extent = middles.max - middles.min;
    let axis = (0..3).max_by(|a, b| extent[*a].total_cmp(&extent[*b]))?;
    let in_halves = |boxed: &mut [Boxed]| {
        let by_middle = |a: &Boxed, b: &Boxed| a.middle()[axis].total_cmp(&b.middle()[axis]);
        boxed.select_nth_unstable_by(count / 2, by_middle);
        Some(count / 2)
    };
    if depth > MAX_UNEVEN_DEPTH {
        return in_halves(boxed);
    }
    let scale = BINS as f32 / extent[axis];
    let bin = |boxed: &Boxed| {
        let bin = (boxed.middle()[axis] - middles.min[axis]) * scale;
        (bin as usize).min(BINS - 1)
    };
    let best = best_split(boxed, bin);
    let leaf_cost = bounds.half_area() * (count - 1) as f32;
    match best {
        // All middles are in one place, or too far apart for 32 bits.
        None if count <= MAX_IN_LEAF => None,
        None => in_halves(boxed),
        Some((cost, _)) if count <= MAX_IN_LEAF && cost >= leaf_cost => None,
        Some((_, first_bin)) => {
            let (mut left, mut right) = (0, count);
            while left < right {
                if bin(&boxed[left]) < first_bin {
                    left += 1;
                } else {
                    right -= 1;
                    boxed.swap(left, right);
                }
            }
            Some(left)
        }
    }
}

/// The cheapest split between bins that leaves something on both sides: its cost, and the first bin of the
/// right side.
fn best_split(boxed: &[Boxed], bin: impl Fn(&Boxed) -> usize) -> Option<(f32, usize)> {
    let mut bins = [(0, Aabb::empty()); BINS];
    for boxed in boxed {
        let (count, bounds) = &mut bins[bin(boxed)];
        *count += 1;
        *bounds = bounds.union(&boxed.bounds);
    }
    let add = |sum: &mut (usize, Aabb), bin: (usize, Aabb)| {
        *sum = (sum.0 + bin.0, sum.1.union(&bin.1));
        *sum
    };
    let cost = |(count, bounds): (usize, Aabb)| bounds.half_area() * count as f32;
    let mut from_right = [(0, Aabb::empty()); BINS];
    let mut right = (0, Aabb::empty());
    for i in (0..BINS).rev() {
        from_right[i] = add(&mut right, bins[i]);
    }
    let mut left = (0, Aabb::empty());
    let candidates = (1..BINS).filter_map(|first| {
        let left = add(&mut left, bins[first - 1]);
        let right = from_right[first];
        (left.0 > 0 && right.0 > 0).then(|| (cost(left) + cost(right), first))
    });
    candidates.min_by(|a, b| a.0.total_cmp(&b.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Instant;

    fn cube(middle: [f32; 3], half: f32) -> Aabb {
        let middle = Vec3A::from_array(middle);
        Aabb::new(middle - half, middle + half)
    }

    /// Every box is in one leaf, and every node holds what is below it.
    fn check(boxes: &[Aabb], bvh: &Bvh2) {
        let mut found = vec![0; boxes.len()];
        let mut open = vec![(0, 1)];
        while let Some((node, depth)) = open.pop() {
            let node = &bvh.nodes[node];
            assert!(depth <= bvh.max_depth);
            let first = node.first_index as usize;
            let holds = |inner: &Aabb| {
                let bounds = node.aabb();
                bounds.min.cmple(inner.min).all() && bounds.max.cmpge(inner.max).all()
            };
            if node.is_leaf() {
                for index in &bvh.primitive_indices[first..first + node.prim_count as usize] {
                    found[*index as usize] += 1;
                    assert!(holds(&boxes[*index as usize]));
                }
            } else {
                for child in [first, first + 1] {
                    assert!(holds(bvh.nodes[child].aabb()));
                    open.push((child, depth + 1));
                }
            }
        }
        assert_eq!(found, vec![1; boxes.len()]);
    }

    #[test]
    fn no_boxes_make_it_slow_or_deep() {
        const COUNT: usize = 60_000;
        let one = vec![cube([1.0, 2.0, 3.0], 1.0); COUNT];
        let nested = (0..COUNT).map(|i| cube([0.0; 3], 1.0 + i as f32));
        let dwindling = (0..COUNT).map(|i| cube([0.5f32.powi(i as i32 % 120), 0.0, 0.0], 0.0));
        let row = (0..COUNT).map(|i| cube([i as f32, 0.0, 0.0], i as f32));
        let huge = (0..COUNT).map(|i| cube([[-1.0f32, 1.0][i % 2] * 3e38, 0.0, 0.0], 1.0));
        for boxes in [
            one,
            nested.collect(),
            dwindling.collect(),
            row.collect(),
            huge.collect(),
        ] {
            let start = Instant::now();
            let bvh = build(&boxes);
            assert!(start.elapsed().as_secs_f64() < 5.0, "{:?}", start.elapsed());
            assert!(bvh.max_depth <= 96, "{}", bvh.max_depth);
            check(&boxes, &bvh);
        }
    }

    #[test]
    fn few_boxes_are_all_there() {
        assert!(build(&[]).nodes.is_empty());
        for count in 1..40 {
            let boxes: Vec<_> = (0..count)
                .map(|i| cube([(i * 7 % 5) as f32, (i * 3 % 4) as f32, 0.0], 0.25))
                .collect();
            check(&boxes, &build(&boxes));
        }
    }
}
