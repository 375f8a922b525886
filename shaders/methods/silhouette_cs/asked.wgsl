// What is found of edges.
#include "methods/silhouette/multiplicity.wgsl"

// Of each edge that is marked: both sums, in 16 bits each.
@group(1) @binding(4) var<storage, read_write> multiplicities: array<u32>;

fn pack(sums: vec2<i32>) -> u32 {
    return (u32(sums.x) & 0xffffu) | (u32(sums.y) << 16u);
}
