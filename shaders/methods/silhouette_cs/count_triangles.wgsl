// How many corners the caps of each block's triangles have: see count_edges.wgsl.
#include "methods/silhouette_cs/caps.wgsl"

@group(1) @binding(3) var<storage, read_write> corners: array<vec4<u32>>;

@compute @workgroup_size(64)
fn count_triangles(@builtin(global_invocation_id) at: vec3<u32>) {
    let number = at.x;
    if number >= arrayLength(&blocks) {
        return;
    }
    let block = block_at(number);
    if !block.are_triangles {
        return;
    }
    let plan = plan_of(block.caster);
    var front = 0u;
    var back = 0u;
    for (var i = 0u; i < block.count; i++) {
        let caps = triangle_caps(plan, facing_of(block.first + i));
        front += select(0u, 3u, caps.front);
        back += select(0u, 3u, caps.back);
    }
    corners[number] = vec4<u32>(
        0u,
        select(front, 0u, front_everywhere),
        select(0u, front, front_everywhere) + back,
        0u,
    );
}
