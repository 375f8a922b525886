// Finds the nodes of a level that have only those below that are all in shadow.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/level.wgsl"

@group(2) @binding(0) var<storage, read_write> dark: array<u32>;

@compute @workgroup_size(64)
fn darken_nodes(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let number = invocation(at, workgroups);
    if number >= count * slices {
        return;
    }
    let node = node_of_level(number);
    let below = first_below(node);
    dark[node] |= dark[below] & dark[below + 1u] & dark[below + 2u] & dark[below + 3u];
}
