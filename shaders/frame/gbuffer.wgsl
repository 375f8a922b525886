// Depth, and for every pixel the number of the triangle that it shows, plus 1 (0: none).
#include "shared/frame.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;

struct Varying {
    @builtin(position) @invariant position: vec4<f32>,
    @location(0) @interpolate(flat) id: u32,
}

// The same operations in the same order as `to_clip` of shared/extrude.glsl: a front cap then covers
// exactly the pixels that its triangle covers here.
fn to_clip(p: vec3<f32>) -> vec4<f32> {
    let m = frame.view_projection;
    return (m[0] * p.x + m[1] * p.y) + (m[2] * p.z + m[3]);
}

// Three vertices a triangle, none shared: so each can say which triangle it belongs to. Few devices outside of
// Vulkan let the fragment shader ask for that, and here it takes longer.
@vertex
fn vertex(@builtin(vertex_index) corner: u32) -> Varying {
    return Varying(to_clip(positions[indices[corner]].xyz), corner / 3u + 1u);
}

@fragment
fn fragment(in: Varying) -> @location(0) u32 {
    return in.id;
}
