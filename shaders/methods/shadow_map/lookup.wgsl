// Adds to the shadow mask what the shadow map says: nearest texel, one comparison a pixel.
#include "shared/frame.wgsl"
#include "shared/fullscreen.wgsl"

struct Light {
    view_projection: mat4x4<f32>,
}

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var map: texture_depth_2d;
@group(1) @binding(2) var<uniform> light: Light;

@fragment
fn lookup(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let depth_here = textureLoad(depth, vec2<i32>(at.xy), 0);
    if depth_here == 0.0 {
        discard;
    }
    let position = surface_position(at.xy, depth_here);
    let clip = light.view_projection * vec4<f32>(position, 1.0);
    let inside = abs(clip.xy) < vec2<f32>(clip.w);
    if !all(inside) {
        discard;
    }
    let ndc = clip.xyz / clip.w;
    let size = vec2<f32>(textureDimensions(map));
    let texel = vec2<i32>(vec2<f32>(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * size);
    // Beyond the farthest caster everything is as far as the farthest caster.
    if min(ndc.z, 1.0) <= textureLoad(map, texel, 0) {
        discard;
    }
    return vec4<f32>(1.0);
}
