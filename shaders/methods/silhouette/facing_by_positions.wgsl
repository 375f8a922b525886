// Facings of the triangles of an edge, found by the edge itself.
#include "shared/frame.wgsl"
#include "shared/facing.wgsl"

@group(1) @binding(6) var<storage, read> positions: array<vec4<f32>>;

// Ends of the edge that is asked, in the vertex order.
var<private> end_a: vec3<f32>;
var<private> end_b: vec3<f32>;

// The facing along it of the triangle with this opposite vertex.
fn facing_along(opposite: u32, along: i32) -> i32 {
    return sorted_facing(sort_third(end_a, end_b, positions[opposite].xyz), frame.light);
}
