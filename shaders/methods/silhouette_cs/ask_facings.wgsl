// Edges look up the facings of their triangles.
#include "methods/silhouette_cs/count_edges.wgsl"

// See facings.wgsl.
@group(1) @binding(7) var<storage, read> facings: array<vec2<u32>>;

// The facing along an edge of the triangle of this number.
fn facing_along(edge: vec4<u32>, triangle: u32, along: i32) -> i32 {
    let bits = (facings[triangle / 32u] >> vec2<u32>(triangle % 32u)) & vec2<u32>(1u);
    return along * (i32(bits.x) - i32(bits.y));
}
