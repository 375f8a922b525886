// The lit picture: clay under one light and a soft sky, with the shadow mask applied.
#include "shared/fullscreen.wgsl"

@group(0) @binding(0) var triangle_ids: texture_2d<u32>;
@group(0) @binding(1) var shadow_mask: texture_2d<f32>;
// See visible_triangles.wgsl.
@group(0) @binding(2) var shading: texture_2d<f32>;

const BACKGROUND = vec3<f32>(0.62, 0.70, 0.78);
const CLAY = vec3<f32>(0.78, 0.75, 0.70);
const SKY = vec3<f32>(0.22, 0.25, 0.30);
const SOIL = vec3<f32>(0.16, 0.14, 0.12);
const SUN = vec3<f32>(0.58, 0.56, 0.50);

@fragment
fn shade(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    let id = textureLoad(triangle_ids, pixel, 0).x;
    let terms = textureLoad(shading, pixel, 0).xy;
    let lit = 1.0 - textureLoad(shadow_mask, pixel, 0).x;
    let sky = mix(SOIL, SKY, 0.5 + 0.5 * terms.x);
    // Near enough to a screen's curve, and much faster than a power.
    let colour = sqrt(CLAY * (sky + SUN * (lit * max(terms.y, 0.0))));
    return vec4<f32>(select(colour, BACKGROUND, id == 0u), 1.0);
}
