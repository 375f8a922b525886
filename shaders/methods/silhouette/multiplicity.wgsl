// How often the faces of an edge count. Who includes this says how the facing of a triangle is found.
#include "methods/silhouette/plans.wgsl"

// Ends in the vertex order, where its triangles begin, and in a word how many they are (15 bits) and whose edge it is.
@group(1) @binding(2) var<storage, read> edges: array<vec4<u32>>;
// Of each triangle of an edge its opposite vertex, or its number; and in the lowest bit whether it goes from the second end to
// the first.
@group(1) @binding(3) var<storage, read> sides: array<u32>;

// x: the sum of the facings of the triangles that cast. y: less the sum of windings, for the second count of EACH_SIDE.
fn multiplicities_of(edge: vec4<u32>) -> vec2<i32> {
    let plan = plan_of(edge.w >> 15u);
    if !plan.is_drawn {
        return vec2<i32>(0);
    }
    let count = edge.w & 0x7fffu;
    var of_casting = 0;
    var open = 0;
    for (var i = 0u; i < count; i++) {
        let side = sides[edge.z + i];
        let along = 1 - 2 * i32(side & 1u);
        let facing = facing_along(side >> 1u, along);
        of_casting += select(0, facing, plan.casting == ALL || facing == along);
        open += along;
    }
    return vec2<i32>(of_casting, select(0, -open, plan.casting == EACH_SIDE));
}
