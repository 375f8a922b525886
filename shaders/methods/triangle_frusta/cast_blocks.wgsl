// Holds the triangles of a cluster against a block of tiles, a workgroup a block.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/frustum.wgsl"

// Triangles of a cluster.
const CLUSTER: u32 = 32u;

@compute @workgroup_size(CLUSTER)
fn cast_blocks(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = workgroup.y * workgroups.x + workgroup.x;
    if number < part_count() {
        let part = part_at(number);
        cast_triangle(CLUSTER * part.item + lane, part.place);
    }
}
