// What compute shaders know of a picture and change in its shadow mask: see src/frame/pixel_compute.rs.
#include "shared/pixel.wgsl"

@group(1) @binding(0) var<storage, read> triangle_ids: array<u32>;
// Four pixels a word.
@group(1) @binding(1) var<storage, read_write> shadow_mask: array<atomic<u32>>;

// The number of an invocation that has no pixel of its own.
fn invocation(at: vec3<u32>, workgroups: vec3<u32>) -> u32 {
    return at.y * (64u * workgroups.x) + at.x;
}

// The number of a pixel in buffers.
fn pixel_at(at: vec2<u32>) -> u32 {
    return at.y * row_px + at.x;
}

fn is_dark(pixel: u32) -> bool {
    return (atomicLoad(&shadow_mask[pixel / 4u]) >> (8u * (pixel % 4u)) & 0xffu) != 0u;
}

fn darken(pixel: u32) {
    atomicOr(&shadow_mask[pixel / 4u], 0xffu << (8u * (pixel % 4u)));
}

// The triangle whose light is in question, 0 if there is none or it is dark already, else its number plus 1.
fn asked_triangle(at: vec2<u32>) -> u32 {
    if any(at >= vec2<u32>(frame.picture.xy)) {
        return 0u;
    }
    let pixel = pixel_at(at);
    return select(triangle_ids[pixel], 0u, is_dark(pixel));
}
