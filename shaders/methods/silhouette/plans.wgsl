// How the volumes of casters are drawn: twin of src/methods/plan_words.rs.

@group(1) @binding(1) var<storage, read> plans: array<u32>;

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
