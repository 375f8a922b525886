// Makes the boxes of a level from those below.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(0) var<storage, read_write> nodes: array<Node>;

// The first node of the level in each tree, and how many there are.
override first: u32;
override count: u32;

@compute @workgroup_size(64)
fn bound_nodes(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let number = invocation(at, workgroups);
    if number >= count * slices {
        return;
    }
    let tree = number / count * tree_size();
    let node = first + number % count;
    var sum = nodes[tree + 4u * node + 1u];
    for (var child = 4u * node + 2u; child <= 4u * node + 4u; child++) {
        let other = nodes[tree + child];
        sum.low = min(sum.low, other.low);
        sum.high = max(sum.high, other.high);
        sum.uncertainty = max(sum.uncertainty, other.uncertainty);
    }
    nodes[tree + node] = sum;
}
