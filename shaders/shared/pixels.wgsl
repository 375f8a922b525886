// What compute shaders know of a picture and change in its shadow mask: see src/frame/pixel_compute.rs.
#include "shared/pixel.wgsl"

@group(1) @binding(0) var<storage, read> triangle_ids: array<u32>;
// Four pixels a word.
@group(1) @binding(1) var<storage, read_write> shadow_mask: array<atomic<u32>>;

// The triangle whose light is in question, 0 if there is none or it is dark already, else its number plus 1.
fn asked_triangle(at: vec2<u32>) -> u32 {
    if any(at >= vec2<u32>(frame.picture.xy)) {
        return 0u;
    }
    let pixel = at.y * row_px + at.x;
    let is_dark = (atomicLoad(&shadow_mask[pixel / 4u]) >> (8u * (pixel % 4u)) & 0xffu) != 0u;
    return select(triangle_ids[pixel], 0u, is_dark);
}

fn darken(at: vec2<u32>) {
    let pixel = at.y * row_px + at.x;
    atomicOr(&shadow_mask[pixel / 4u], 0xffu << (8u * (pixel % 4u)));
}
