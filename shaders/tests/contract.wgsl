// A compute pass that writes a draw's numbers and corners: one half of the picture, left or right in turns.
#include "shared/fullscreen.wgsl"

@group(0) @binding(0) var<storage, read_write> corners: array<vec4<f32>, 6>;
// Vertex count, instance count, first vertex, first instance.
@group(0) @binding(1) var<storage, read_write> draw: array<u32, 4>;
@group(0) @binding(2) var<storage, read_write> frame: u32;

@compute @workgroup_size(1)
fn find_half() {
    let low = select(0.0, -1.0, frame % 2u == 0u);
    let high = low + 1.0;
    corners[0] = vec4<f32>(low, -1.0, 0.5, 1.0);
    corners[1] = vec4<f32>(high, -1.0, 0.5, 1.0);
    corners[2] = vec4<f32>(high, 1.0, 0.5, 1.0);
    corners[3] = corners[0];
    corners[4] = corners[2];
    corners[5] = vec4<f32>(low, 1.0, 0.5, 1.0);
    draw[0] = 6u;
    draw[1] = 1u;
    draw[2] = 0u;
    draw[3] = 0u;
    frame = frame + 1u;
}

@fragment
fn plain() -> @location(0) vec4<f32> {
    return vec4<f32>(1.0);
}
