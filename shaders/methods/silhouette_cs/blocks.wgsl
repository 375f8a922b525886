// Blocks of edges or triangles, and how the volumes of casters are drawn: twins of src/methods/silhouette_cs/blocks.rs and
// plans.rs there.

@group(1) @binding(0) var<storage, read> blocks: array<vec2<u32>>;
@group(1) @binding(1) var<storage, read> plans: array<u32>;

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

const ALL: u32 = 0u;
const LIGHT_FACING: u32 = 1u;
const EACH_SIDE: u32 = 2u;

struct Plan {
    is_drawn: bool,
    z_pass: bool,
    casting: u32,
    fan_in_front: bool,
    fan_behind: bool,
    far_ends_meet: bool,
    // What makes a corner's number one of its far end.
    far: u32,
}

fn plan_of(caster: u32) -> Plan {
    let word = plans[caster];
    return Plan(
        (word & 1u) != 0u,
        (word & 2u) != 0u,
        (word >> 2u) & 3u,
        (word & 16u) != 0u,
        (word & 32u) != 0u,
        (word & 64u) != 0u,
        (word >> 8u) << 29u,
    );
}

// Corners of a side quad: where far ends meet, a triangle.
fn side_corners(plan: Plan) -> u32 {
    return select(6u, 3u, plan.far_ends_meet);
}
