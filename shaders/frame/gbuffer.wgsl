// Depth, and for every pixel the number of the triangle that it shows, plus 1 (0: none).
enable primitive_index;

#include "shared/frame.wgsl"

struct Varying {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) @interpolate(flat) first_triangle: u32,
}

// The same operations in the same order as `to_clip` of shared/extrude.glsl: a front cap then covers
// exactly the pixels that its triangle covers here.
fn to_clip(p: vec3<f32>) -> vec4<f32> {
    let m = frame.view_projection;
    return (m[0] * p.x + m[1] * p.y) + (m[2] * p.z + m[3]);
}

// The instance number carries the object's first triangle: each object is its own draw call.
@vertex
fn vertex(@location(0) position: vec3<f32>, @builtin(instance_index) first_triangle: u32) -> Varying {
    return Varying(to_clip(position), first_triangle);
}

@fragment
fn fragment(in: Varying, @builtin(primitive_index) triangle: u32) -> @location(0) u32 {
    return in.first_triangle + triangle + 1u;
}
