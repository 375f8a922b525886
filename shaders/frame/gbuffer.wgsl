// Depth, and for every pixel the number of the triangle that it shows, plus 1 (0: none).
#include "shared/frame.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;

struct Varying {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) @interpolate(flat, first) id: u32,
}

// The same operations in the same order as `to_clip` of shared/extrude.glsl: a front cap then covers
// exactly the pixels that its triangle covers here.
fn to_clip(p: vec3<f32>) -> vec4<f32> {
    let m = frame.view_projection;
    return (m[0] * p.x + m[1] * p.y) + (m[2] * p.z + m[3]);
}

// Of the first vertex of a triangle, `number` is that of the triangle: see src/frame/numbered.rs.
@vertex
fn vertex(@builtin(vertex_index) number: u32, @location(0) vertex: u32) -> Varying {
    return Varying(to_clip(positions[vertex].xyz), number + 1u);
}

@fragment
fn fragment(in: Varying) -> @location(0) u32 {
    return in.id;
}
