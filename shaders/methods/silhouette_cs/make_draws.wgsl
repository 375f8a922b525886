// Indirect draws of all faces in each list.

struct Draw {
    index_count: u32,
    instance_count: u32,
    first_index: u32,
    base_vertex: u32,
    first_instance: u32,
}

// Where the corners of each block begin in each list, and the end.
@group(1) @binding(0) var<storage, read> corners: array<vec4<u32>>;
// The first block of each draw, and the end.
@group(1) @binding(1) var<storage, read> first_blocks: array<u32>;
// Round after round, list after list.
@group(1) @binding(2) var<storage, read_write> draws: array<Draw>;

// Of each list in a round.
override draw_count: u32;
override corners_a_round: u32;
override rounds: u32;

@compute @workgroup_size(64)
fn make_draws(@builtin(global_invocation_id) at: vec3<u32>) {
    if at.x >= draw_count {
        return;
    }
    let first = corners[first_blocks[at.x]];
    let end = corners[first_blocks[at.x + 1u]];
    for (var number = 0u; number < rounds; number++) {
        let start = vec4<u32>(number * corners_a_round);
        let from_start = max(first, start) - start;
        let to = max(min(end, start + corners_a_round), start) - start;
        for (var list = 0u; list < 4u; list++) {
            let draw = (4u * number + list) * draw_count + at.x;
            let from_corner = min(from_start[list], to[list]);
            draws[draw] = Draw(to[list] - from_corner, 1u, from_corner, 0u, 0u);
        }
    }
}
