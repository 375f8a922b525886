// The shadow mask before any method: surfaces whose visible side faces away from the light.
//
// They need no shadow to be dark, and no method need find them. Shadow volumes could not always: the side
// quads of a surface that the light sees nearly edge-on lie in its own plane, to the last bit of depth,
// and their order is then a matter of luck.
#include "shared/frame.wgsl"
#include "shared/facing.wgsl"
#include "shared/fullscreen.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;
@group(2) @binding(0) var triangle_ids: texture_2d<u32>;

@fragment
fn dark_sides(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let id = textureLoad(triangle_ids, vec2<i32>(at.xy), 0).x;
    if id == 0u {
        return vec4<f32>(0.0);
    }
    let first = 3u * (id - 1u);
    let a = positions[indices[first]].xyz;
    let b = positions[indices[first + 1u]].xyz;
    let c = positions[indices[first + 2u]].xyz;
    // Eye and light on different sides of the triangle's plane.
    let is_dark = facing(a, b, c, frame.light) * facing(a, b, c, frame.eye) < 0;
    return vec4<f32>(select(0.0, 1.0, is_dark));
}
