// Asks every edge, by the facings of all triangles, and marks those with faces.
#include "methods/silhouette_cs/blocks.wgsl"
#include "methods/silhouette_cs/facing_bits.wgsl"
#include "methods/silhouette_cs/asked.wgsl"

// See find_facings.wgsl.
@group(1) @binding(5) var<storage, read> facings: array<vec2<u32>>;
// A bit for each edge of a block.
@group(1) @binding(6) var<storage, read_write> marks: array<u32>;

// The facing along its edge of the triangle of this number.
fn facing_along(triangle: u32, along: i32) -> i32 {
    return along * facing_in(facings[triangle / 32u], triangle);
}

@compute @workgroup_size(64)
fn ask_facings(@builtin(global_invocation_id) at: vec3<u32>) {
    let number = at.x;
    if number >= arrayLength(&blocks) {
        return;
    }
    let block = block_at(number);
    if block.are_triangles {
        return;
    }
    var marked = 0u;
    for (var i = 0u; i < block.count; i++) {
        let sums = multiplicities_of(edges[block.first + i]);
        multiplicities[block.first + i] = pack(sums);
        marked |= select(0u, 1u, any(sums != vec2<i32>(0))) << i;
    }
    marks[number] = marked;
}
