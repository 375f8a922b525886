// Depth, and for every pixel the number of the triangle that it shows, plus 1 (0: none).
enable primitive_index;

#include "shared/frame.wgsl"

struct Varying {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) first_triangle: u32,
}

// The instance number carries the object's first triangle: each object is its own draw call.
@vertex
fn vertex(@location(0) position: vec3<f32>, @builtin(instance_index) first_triangle: u32) -> Varying {
    return Varying(frame.view_projection * vec4<f32>(position, 1.0), first_triangle);
}

@fragment
fn fragment(in: Varying, @builtin(primitive_index) triangle: u32) -> @location(0) u32 {
    return in.first_triangle + triangle + 1u;
}
