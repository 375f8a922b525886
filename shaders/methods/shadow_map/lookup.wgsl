// Shadow mask from the shadow map: nearest texel, one comparison a pixel.
#include "shared/dark_side.wgsl"
#include "shared/fullscreen.wgsl"

struct Light {
    view_projection: mat4x4<f32>,
}

@group(2) @binding(0) var triangle_ids: texture_2d<u32>;
@group(2) @binding(1) var depth: texture_depth_2d;
@group(2) @binding(2) var map: texture_depth_2d;
@group(2) @binding(3) var<uniform> light: Light;

const LIT = vec4<f32>(0.0);
const SHADOWED = vec4<f32>(1.0);

@fragment
fn lookup(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    let id = textureLoad(triangle_ids, pixel, 0).x;
    if id == 0u {
        return LIT;
    }
    if shows_dark_side(id) {
        return SHADOWED;
    }
    let position = surface_position(at.xy, textureLoad(depth, pixel, 0));
    let clip = light.view_projection * vec4<f32>(position, 1.0);
    let inside = abs(clip.xy) < vec2<f32>(clip.w);
    if !all(inside) {
        return LIT;
    }
    let ndc = clip.xyz / clip.w;
    let size = vec2<f32>(textureDimensions(map));
    let texel = vec2<i32>(vec2<f32>(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * size);
    // Beyond the farthest caster everything is as far as the farthest caster.
    return select(LIT, SHADOWED, min(ndc.z, 1.0) > textureLoad(map, texel, 0));
}
