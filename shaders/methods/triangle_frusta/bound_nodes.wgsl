// Makes the boxes of a level from those below.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(0) var<storage, read_write> nodes: array<Node>;

@compute @workgroup_size(64)
fn bound_nodes(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let number = invocation(at, workgroups);
    if number >= count * slices {
        return;
    }
    let node = node_of_level(number);
    let below = first_below(node);
    var sum = nodes[below];
    for (var child = below + 1u; child < below + 4u; child++) {
        let other = nodes[child];
        sum.low = min(sum.low, other.low);
        sum.high = max(sum.high, other.high);
        sum.uncertainty = max(sum.uncertainty, other.uncertainty);
    }
    nodes[node] = sum;
}
