// Adds to the shadow mask what the shadow map says: of a square of texels around the nearest one, the part
// that is nearer to the light (percentage-closer filtering, Reeves, Salesin and Cook 1987).
#include "shared/frame.wgsl"
#include "shared/fullscreen.wgsl"
#include "methods/shadow_map/bias.wgsl"

// Twin of `LookupLight` in src/methods/shadow_map.rs.
struct Light {
    // As in map.wgsl.
    view_projection: mat4x4<f32>,
    origin: vec4<f32>,
    // What a step of 1 towards the light adds to clip space.
    step: vec4<f32>,
    rounding: vec4<f32>,
}

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var map: texture_depth_2d;
@group(1) @binding(2) var<uniform> light: Light;

// Side of the square, odd.
override pcf: i32 = 1;

@fragment
fn lookup(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let depth_here = textureLoad(depth, vec2<i32>(at.xy), 0);
    if is_background(depth_here) {
        discard;
    }
    let position = relative_position(at.xy, depth_here, light.origin.xyz);
    let clip = light.view_projection * vec4<f32>(position, 1.0);
    let inside = abs(clip.xy) < vec2<f32>(clip.w);
    if !all(inside) {
        discard;
    }
    let ndc = clip.xy / clip.w;
    let size = vec2<i32>(textureDimensions(map));
    let nearest = vec2<i32>(vec2<f32>(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * vec2<f32>(size));
    let biased = clip + rounding_distance(light.rounding.xy) * light.step;
    // Nearer than rounding can tell: nothing is before it.
    if biased.w <= 0.0 {
        discard;
    }
    // Beyond the farthest caster everything is as far as the farthest caster.
    let depth_from_light = max(biased.z / biased.w, 0.0);
    let reach = pcf / 2;
    var shadowed = 0;
    for (var y = -reach; y <= reach; y++) {
        for (var x = -reach; x <= reach; x++) {
            let texel = nearest + vec2<i32>(x, y);
            // Outside of the map nothing casts.
            if all(texel >= vec2<i32>(0)) && all(texel < size) && textureLoad(map, texel, 0) > depth_from_light {
                shadowed++;
            }
        }
    }
    return vec4<f32>(f32(shadowed) / f32(pcf * pcf));
}
