// What is done level by level.
#include "methods/triangle_frusta/tree.wgsl"

// The first node of the level in each tree, and how many there are.
override first: u32;
override count: u32;

// A node of the level, and the first of those below it, among those of all trees.
fn node_of_level(number: u32) -> u32 {
    return number / count * tree_size() + first + number % count;
}

fn first_below(node: u32) -> u32 {
    let tree = node / tree_size() * tree_size();
    return tree + 4u * (node - tree) + 1u;
}
