// Stencil count to shadow mask. The stencil test picks the pixels whose count is 0 or is not, the depth
// test those that show something.
#include "shared/dark_side.wgsl"
#include "shared/fullscreen.wgsl"

@group(2) @binding(0) var triangle_ids: texture_2d<u32>;

// Count is not 0: in shadow.
@fragment
fn counted() -> @location(0) vec4<f32> {
    return vec4<f32>(1.0);
}

// Count is 0: still dark where the surface faces away from the light. Its own volume should have said so,
// but the side quads of a surface seen nearly edge-on by the light lie in its own plane, to the last bit of
// depth, and their order is then a matter of luck.
@fragment
fn uncounted(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let id = textureLoad(triangle_ids, vec2<i32>(at.xy), 0).x;
    return vec4<f32>(select(0.0, 1.0, shows_dark_side(id)));
}
