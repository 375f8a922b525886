// The lit picture: clay under one light and a soft sky, with the shadow mask applied.
#include "shared/fullscreen.wgsl"
#include "shared/pixel.wgsl"

// The shadow mask, four pixels a word.
@group(0) @binding(0) var<storage, read> shadow_mask: array<u32>;
@group(0) @binding(1) var<storage, read> surfaces: array<u32>;

const BACKGROUND = vec3<f32>(0.62, 0.70, 0.78);
const CLAY = vec3<f32>(0.78, 0.75, 0.70);
const SKY = vec3<f32>(0.22, 0.25, 0.30);
const SOIL = vec3<f32>(0.16, 0.14, 0.12);
const SUN = vec3<f32>(0.58, 0.56, 0.50);

@fragment
fn shade(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = pixel_index(at);
    let surface = surfaces[pixel];
    let terms = unpack2x16snorm(surface);
    let lit = 1.0 - unpack4x8unorm(shadow_mask[pixel / 4u] >> (8u * (pixel % 4u))).x;
    let sky = mix(SOIL, SKY, 0.5 + 0.5 * terms.x);
    // Near enough to a screen's curve, and much faster than a power.
    let colour = sqrt(CLAY * (sky + SUN * (lit * max(terms.y, 0.0))));
    return vec4<f32>(select(colour, BACKGROUND, surface == NO_SURFACE), 1.0);
}
