// From world to clip space, at a vertex and at the far end of its shadow: the twin of shared/extrude.glsl. WGSL has no
// `precise`, so faces that must meet without gaps are drawn by one entry point, or by pipelines that share one.
#include "shared/frame.wgsl"

// The vertex itself.
fn clip_near(p: vec3<f32>) -> vec4<f32> {
    return frame.view_projection * vec4<f32>(p, 1.0);
}

// Where the ray from the light through the vertex ends: on one of the end planes (geometry/end_plane.rs).
fn clip_far(p: vec3<f32>, end_plane: u32) -> vec4<f32> {
    let plane = frame.end_planes[end_plane];
    let of_light = dot(plane, frame.light);
    let of_p = dot(plane, vec4<f32>(p, 1.0));
    return frame.view_projection * (vec4<f32>(p, 1.0) * of_light - frame.light * of_p);
}
