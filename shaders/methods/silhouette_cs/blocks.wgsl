// Blocks of edges or triangles: twin of src/methods/silhouette_cs/blocks.rs.
#include "methods/silhouette/plans.wgsl"

@group(1) @binding(0) var<storage, read> blocks: array<vec2<u32>>;

// Up to 32 edges or triangles of one caster.
struct Block {
    first: u32,
    count: u32,
    are_triangles: bool,
    caster: u32,
}

fn block_at(number: u32) -> Block {
    let word = blocks[number];
    return Block(word.x, word.y & 0x3fu, (word.y & 0x40u) != 0u, word.y >> 7u);
}
