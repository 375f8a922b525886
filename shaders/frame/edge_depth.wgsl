// Moves depth where visible_triangles.wgsl says so. A pass of its own, for depth that is written everywhere would have to be
// computed everywhere, to the bits of the rasteriser.
#include "shared/fullscreen.wgsl"

@group(0) @binding(0) var moved_depth: texture_2d<f32>;

@fragment
fn edge_depth(@builtin(position) at: vec4<f32>) -> @builtin(frag_depth) f32 {
    let depth = textureLoad(moved_depth, vec2<i32>(at.xy), 0).x;
    if depth > 1.0 {
        discard;
    }
    return depth;
}
