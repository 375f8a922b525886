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
    var low = vec3<f32>(3e38);
    var high = vec3<f32>(-3e38);
    var uncertainty = 0.0;
    for (var child = below; child < below + 4u; child++) {
        let part = nodes[child];
        if !is_empty(part) {
            low = min(low, part.centre - part.extent);
            high = max(high, part.centre + part.extent);
            uncertainty = max(uncertainty, part.uncertainty);
        }
    }
    nodes[node] = node_of(low, high, uncertainty);
}
