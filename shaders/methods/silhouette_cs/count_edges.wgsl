// How many corners the faces of each block's edges have, by how they are counted. That does not depend on the order of
// invocations, so nor does the order of faces.
#include "methods/silhouette_cs/blocks.wgsl"
#include "methods/silhouette_cs/weights.wgsl"

// The edges of each block with faces.
@group(1) @binding(2) var<storage, read> marks: array<u32>;
// See multiplicity.wgsl.
@group(1) @binding(3) var<storage, read> multiplicities: array<u32>;
// Of each block: those of sides where depth passes, of faces where it fails, of faces everywhere, and of open edges.
@group(1) @binding(4) var<storage, read_write> corners: array<vec4<u32>>;

// Corners of a block's edges.
fn of_edges(block: Block, plan: Plan, marked: u32) -> vec4<u32> {
    var quads = vec2<u32>(0u);
    for (var left = marked; left != 0u; left &= left - 1u) {
        let sums = bitcast<i32>(multiplicities[block.first + firstTrailingBit(left)]);
        quads += vec2<u32>(faces_of(extractBits(sums, 0u, 16u)), faces_of(extractBits(sums, 16u, 16u)));
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
        counts = of_edges(block, plan_of(block.caster), marked);
    }
    corners[number] = counts;
}
