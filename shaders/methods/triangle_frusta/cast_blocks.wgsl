// Holds the triangles of a cluster against a block of tiles, a workgroup a block.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/frustum.wgsl"

@compute @workgroup_size(CLUSTER)
fn cast_blocks(
    @builtin(workgroup_id) workgroup: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = number_of(workgroup, workgroups);
    if number < part_count() {
        let part = part_at(number);
        cast_triangle(CLUSTER * part.item + lane, part.place);
    }
}
