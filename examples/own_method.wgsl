// Adds the shadows of spheres to the mask. svbench's own files can be included by their paths below shaders/.
#include "shared/frame.wgsl"
#include "shared/fullscreen.wgsl"

@group(1) @binding(0) var depth: texture_depth_2d;
// Centre and radius.
@group(1) @binding(1) var<storage, read> spheres: array<vec4<f32>>;

// Whether a sphere is between a point and the light; none shadows what is inside of it.
fn blocks(sphere: vec4<f32>, point: vec3<f32>) -> bool {
    let to_light = frame.light.xyz - frame.light.w * point;
    let to_centre = sphere.xyz - point;
    // Where on the way to the light the centre is nearest: at 1 is the light, if it is not at infinity.
    let along = dot(to_centre, to_light) / dot(to_light, to_light);
    let is_between = along > 0.0 && (along < 1.0 || frame.light.w == 0.0);
    return is_between && length(to_centre) > sphere.w && distance(to_centre, along * to_light) < sphere.w;
}

@fragment
fn sphere_shadow(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let depth_here = textureLoad(depth, vec2<i32>(at.xy), 0);
    let point = surface_position(at.xy, depth_here);
    for (var i = 0u; i < arrayLength(&spheres) && !is_background(depth_here); i++) {
        if blocks(spheres[i], point) {
            return vec4<f32>(1.0);
        }
    }
    return vec4<f32>(0.0);
}
