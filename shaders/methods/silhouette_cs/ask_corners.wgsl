// Edges find the facings of their own triangles.
#include "shared/frame.wgsl"
#include "shared/facing.wgsl"
#include "methods/silhouette_cs/count_edges.wgsl"

@group(1) @binding(7) var<storage, read> positions: array<vec4<f32>>;

// The facing along an edge of the triangle with this opposite vertex.
fn facing_along(edge: vec4<u32>, opposite: u32, along: i32) -> i32 {
    return facing(positions[edge.x].xyz, positions[edge.y].xyz, positions[opposite].xyz, frame.light);
}
