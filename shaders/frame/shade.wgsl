// The lit picture: clay under one light and a soft sky, with the shadow mask applied.
#include "shared/frame.wgsl"
#include "shared/fullscreen.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;
@group(2) @binding(0) var triangle_ids: texture_2d<u32>;
@group(2) @binding(1) var shadow_mask: texture_2d<f32>;
@group(2) @binding(2) var depth: texture_depth_2d;

const BACKGROUND = vec3<f32>(0.62, 0.70, 0.78);
const CLAY = vec3<f32>(0.78, 0.75, 0.70);
const SKY = vec3<f32>(0.22, 0.25, 0.30);
const SOIL = vec3<f32>(0.16, 0.14, 0.12);
const SUN = vec3<f32>(0.58, 0.56, 0.50);

@fragment
fn shade(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = vec2<i32>(at.xy);
    let id = textureLoad(triangle_ids, pixel, 0).x;
    if id == 0u {
        return vec4<f32>(BACKGROUND, 1.0);
    }
    let first = 3u * (id - 1u);
    let a = positions[indices[first]].xyz;
    let b = positions[indices[first + 1u]].xyz;
    let c = positions[indices[first + 2u]].xyz;
    let position = surface_position(at.xy, textureLoad(depth, pixel, 0));
    // Scaled before the cross product: tiny triangles would underflow.
    let e1 = normalize(b - a);
    let e2 = normalize(c - a);
    var normal = normalize(cross(e1, e2));
    normal = select(normal, -normal, dot(normal, frame.eye.xyz - position) < 0.0);
    let to_light = normalize(frame.light.xyz - position * frame.light.w);
    let lit = 1.0 - textureLoad(shadow_mask, pixel, 0).x;
    let sky = mix(SOIL, SKY, 0.5 + 0.5 * normal.y);
    let colour = CLAY * (sky + SUN * (lit * max(dot(normal, to_light), 0.0)));
    return vec4<f32>(pow(colour, vec3<f32>(1.0 / 2.2)), 1.0);
}
