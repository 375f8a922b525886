// Sides and fans.
#include "methods/silhouette_cs/blocks.wgsl"
#include "methods/silhouette_cs/elements.wgsl"
#include "methods/silhouette_cs/weights.wgsl"

// See multiplicity.wgsl.
@group(1) @binding(2) var<storage, read> edges: array<vec4<u32>>;
@group(1) @binding(3) var<storage, read> marks: array<u32>;
@group(1) @binding(4) var<storage, read> multiplicities: array<u32>;
// A vertex of each vertex's part of a surface.
@group(1) @binding(5) var<storage, read> apexes: array<u32>;

// The side quads of an edge. Both windings are cut along one diagonal: see src/methods/side_quad.rs. Gives where to go on.
fn emit_sides(first: u32, edge: vec4<u32>, multiplicity: i32, plan: Plan) -> u32 {
    let is_left = multiplicity > 0;
    var at = first;
    for (var quad = 0u; quad < faces_of(multiplicity); quad++) {
        let weight = weight_bits(multiplicity, quad);
        let a = edge.x | weight;
        let b = edge.y | weight;
        let far_a = select(a, weight, plan.far_ends_meet) | plan.far;
        let far_b = b | plan.far;
        emit(at, a, select(b, far_a, is_left), select(far_a, b, is_left));
        if !plan.far_ends_meet {
            emit(at + 3u, b, select(far_b, far_a, is_left), select(far_a, far_b, is_left));
        }
        at += side_corners(plan);
    }
    return at;
}

// The triangles of caps between an edge and where the fan of its part of the surface meets.
fn emit_fans(first: u32, edge: vec4<u32>, multiplicity: i32, plan: Plan) -> u32 {
    if !plan.fan_in_front && !plan.fan_behind {
        return first;
    }
    let is_left = multiplicity > 0;
    var at = first;
    for (var i = 0u; i < faces_of(multiplicity); i++) {
        let weight = weight_bits(multiplicity, i);
        let apex = apexes[edge.x] | weight;
        let left = select(edge.y, edge.x, is_left) | weight;
        let right = select(edge.x, edge.y, is_left) | weight;
        if plan.fan_in_front {
            emit(at, apex, left, right);
            at += 3u;
        }
        if plan.fan_behind && !plan.far_ends_meet {
            emit(at, apex | plan.far, right | plan.far, left | plan.far);
            at += 3u;
        }
    }
    return at;
}

@compute @workgroup_size(64)
fn emit_edges(@builtin(global_invocation_id) at: vec3<u32>) {
    let number = at.x;
    if number >= arrayLength(&blocks) || marks[number] == 0u {
        return;
    }
    let block = block_at(number);
    let plan = plan_of(block.caster);
    let places = corners[number];
    var sides = select(places.y, places.x, plan.z_pass);
    var fans = places.z;
    var open = places.w;
    for (var left = marks[number]; left != 0u; left &= left - 1u) {
        let edge = edges[block.first + firstTrailingBit(left)];
        let sums = bitcast<i32>(multiplicities[block.first + firstTrailingBit(left)]);
        let of_casting = extractBits(sums, 0u, 16u);
        if of_casting != 0 {
            sides = emit_sides(sides, edge, of_casting, plan);
            fans = emit_fans(fans, edge, of_casting, plan);
        }
        open = emit_sides(open, edge, extractBits(sums, 16u, 16u), plan);
    }
}
