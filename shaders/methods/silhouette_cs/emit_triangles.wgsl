// Caps of triangles.
#include "methods/silhouette_cs/caps.wgsl"
#include "methods/silhouette_cs/elements.wgsl"

@group(1) @binding(3) var<storage, read> indices: array<u32>;

@compute @workgroup_size(64)
fn emit_triangles(@builtin(global_invocation_id) at: vec3<u32>) {
    let number = at.x;
    if number >= arrayLength(&blocks) {
        return;
    }
    let block = block_at(number);
    if !block.are_triangles {
        return;
    }
    let plan = plan_of(block.caster);
    var tested = corners[number].y;
    var everywhere = corners[number].z;
    for (var i = 0u; i < block.count; i++) {
        let triangle = block.first + i;
        let facing = facing_of(triangle);
        let caps = triangle_caps(plan, facing);
        // Counter-clockwise seen from the light.
        let towards = facing == 1;
        let a = indices[3u * triangle];
        let b = indices[3u * triangle + select(2u, 1u, towards)];
        let c = indices[3u * triangle + select(1u, 2u, towards)];
        if caps.front && front_everywhere {
            emit(everywhere, a, b, c);
            everywhere += 3u;
        }
        if caps.front && !front_everywhere {
            emit(tested, a, b, c);
            tested += 3u;
        }
        if caps.back {
            emit(everywhere, a | plan.far, c | plan.far, b | plan.far);
            everywhere += 3u;
        }
    }
}
