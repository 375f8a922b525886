// From world to clip space, at a vertex and at the far end of its shadow: the twin of shared/extrude.glsl. WGSL has no
// `precise`, so faces that must meet without gaps are drawn by one entry point, or by pipelines that share one.
#include "shared/frame.wgsl"

// Volumes reach to infinity.
override reach_infinity: bool = false;

// The vertex itself.
fn clip_near(p: vec3<f32>) -> vec4<f32> {
    return frame.view_projection * vec4<f32>(p, 1.0);
}

// Where the ray from the light through the vertex ends: on the end plane (geometry/end_plane.rs), or with
// reach_infinity, or without an end plane, at infinity.
fn clip_far(p: vec3<f32>) -> vec4<f32> {
    if reach_infinity {
        return frame.view_projection * vec4<f32>(p * frame.light.w - frame.light.xyz, 0.0);
    }
    let of_light = dot(frame.end_plane, frame.light);
    let of_p = dot(frame.end_plane, vec4<f32>(p, 1.0));
    return frame.view_projection * (vec4<f32>(p, 1.0) * of_light - frame.light * of_p);
}
