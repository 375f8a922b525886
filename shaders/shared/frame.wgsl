// What every stage of a frame knows of the view. Twin of `FrameUniform` in src/frame/uniform.rs.
struct Frame {
    // World to clip space: w = distance before the eye; clip z = near with reversed depth, w - near with
    // standard depth.
    view_projection: mat4x4<f32>,
    // Clip to world space, relative to the eye, so that no precision is lost far from the origin.
    clip_to_eye_ray: mat4x4<f32>,
    // xyz and w = 1 for a point light; direction towards the light and w = 0 for one at infinity.
    light: vec4<f32>,
    eye: vec4<f32>,
    // width, height in pixels; distance of the near plane; depth at infinity.
    picture: vec4<f32>,
    // The planes on which shadow volumes may end, the last at infinity: see geometry/end_plane.rs.
    end_planes: array<vec4<f32>, 7>,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// Whether nothing is there.
fn is_background(depth: f32) -> bool {
    return depth == frame.picture.w;
}

// Depth in [0, 1] at a distance w before the eye.
fn depth_at(w: f32) -> f32 {
    return abs(frame.picture.w - frame.picture.z / w);
}

// From the eye to the surface at a pixel centre, by its depth in [0, 1].
fn eye_ray(pixel: vec2<f32>, depth: f32) -> vec3<f32> {
    let ndc = vec2<f32>(2.0 * pixel.x / frame.picture.x - 1.0, 1.0 - 2.0 * pixel.y / frame.picture.y);
    let ray = (frame.clip_to_eye_ray * vec4<f32>(ndc, 0.0, 1.0)).xyz;
    return ray * (frame.picture.z / abs(depth - frame.picture.w));
}

// World position of the surface at a pixel centre, from its depth in [0, 1].
fn surface_position(pixel: vec2<f32>, depth: f32) -> vec3<f32> {
    return frame.eye.xyz + eye_ray(pixel, depth);
}
