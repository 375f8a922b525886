// Makes the boxes of a level from those below.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/level.wgsl"

@group(2) @binding(0) var<storage, read_write> centres: array<NodeCentre>;
@group(2) @binding(1) var<storage, read_write> extents: array<NodeExtent>;

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
        let part = Node(centres[child], extents[child]);
        if !is_empty(part) {
            low = min(low, part.centre.at - part.extent.half);
            high = max(high, part.centre.at + part.extent.half);
            uncertainty = max(uncertainty, part.centre.uncertainty);
        }
    }
    let sum = node_of(low, high, uncertainty);
    centres[node] = sum.centre;
    extents[node] = sum.extent;
}
