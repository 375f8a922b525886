// How many corners the faces of each block's edges have, by how they are counted. That does not depend on the order of
// invocations, so nor does the order of faces. Who includes this says how the facing of a triangle is found.
#include "methods/silhouette_cs/blocks.wgsl"

// Ends in the vertex order, and where its triangles begin and how many they are.
@group(1) @binding(2) var<storage, read> edges: array<vec4<u32>>;
// Of each triangle of an edge its opposite vertex, or its number; and in the lowest bit whether it goes from the second end to
// the first.
@group(1) @binding(3) var<storage, read> sides: array<u32>;
// The edges of each block that may be on the silhouette.
@group(1) @binding(4) var<storage, read> marks: array<u32>;
// Of each edge that is marked: the sum of the facings of the triangles that cast, and of windings to be counted after the others,
// in 16 bits each.
@group(1) @binding(5) var<storage, read_write> multiplicities: array<u32>;
// Of each block: those of sides where depth passes, of faces where it fails, of faces everywhere, and of open edges.
@group(1) @binding(6) var<storage, read_write> corners: array<vec4<u32>>;

// Both sums of an edge.
fn multiplicities_of(edge: vec4<u32>, casting: u32) -> vec2<i32> {
    var of_casting = 0;
    var open = 0;
    for (var i = 0u; i < edge.w; i++) {
        let side = sides[edge.z + i];
        let along = 1 - 2 * i32(side & 1u);
        let facing = facing_along(edge, side >> 1u, along);
        of_casting += select(0, facing, casting == ALL || facing == along);
        open += along;
    }
    return vec2<i32>(of_casting, select(0, -open, casting == EACH_SIDE));
}

// Corners of a block's edges; sets their multiplicities.
fn of_edges(block: Block, plan: Plan, marked: u32) -> vec4<u32> {
    var quads = vec2<u32>(0u);
    for (var left = marked; left != 0u; left &= left - 1u) {
        let number = block.first + firstTrailingBit(left);
        let sums = multiplicities_of(edges[number], plan.casting);
        multiplicities[number] = (u32(sums.x) & 0xffffu) | (u32(sums.y) << 16u);
        quads += vec2<u32>(abs(sums));
    }
    let sides = quads.x * side_corners(plan);
    let in_front = select(0u, 3u, plan.fan_in_front);
    let behind = select(0u, 3u, plan.fan_behind && !plan.far_ends_meet);
    return vec4<u32>(
        select(0u, sides, plan.z_pass),
        select(sides, 0u, plan.z_pass),
        quads.x * (in_front + behind),
        quads.y * side_corners(plan),
    );
}

@compute @workgroup_size(64)
fn count_edges(@builtin(global_invocation_id) at: vec3<u32>) {
    let number = at.x;
    if number >= arrayLength(&blocks) {
        return;
    }
    let block = block_at(number);
    let marked = marks[number];
    var counts = vec4<u32>(0u);
    if marked != 0u {
        let plan = plan_of(block.caster);
        if plan.is_drawn {
            counts = of_edges(block, plan, marked);
        }
    }
    corners[number] = counts;
}
