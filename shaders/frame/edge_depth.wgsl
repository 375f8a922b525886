// Moves depth where visible_triangles.wgsl says so. A pass of its own, for depth that is written everywhere would have to be
// computed everywhere, to the bits of the rasteriser.
#include "shared/fullscreen.wgsl"
#include "shared/pixel.wgsl"

@group(0) @binding(0) var<storage, read> surfaces: array<u32>;
@group(0) @binding(1) var<storage, read> moved_depths: array<f32>;

@fragment
fn edge_depth(@builtin(position) at: vec4<f32>) -> @builtin(frag_depth) f32 {
    let pixel = pixel_index(at);
    if (surfaces[pixel] & IS_MOVED) == 0u {
        discard;
    }
    return moved_depths[pixel];
}
