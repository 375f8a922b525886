// How far from the light a shadow map's lookup may think that a surface is, for rounding alone. Twin of
// `Rounding` in src/methods/light_depth.rs.

// Needs shared/frame.wgsl. `rounding`: x, the constant bias times half the last bit of 1; y, the largest
// coordinate of scene and light. The surface is known from the G-buffer, where its depth and its place have
// gone through numbers as large as its vertices and the eye.
fn rounding_distance(rounding: vec2<f32>) -> f32 {
    let eye = abs(frame.eye.xyz);
    return rounding.x * (rounding.y + max(eye.x, max(eye.y, eye.z)));
}

// World position of the surface at a pixel centre, relative to `origin`: no digit is lost to how far both are
// from the origin of the world.
fn relative_position(pixel: vec2<f32>, depth: f32, origin: vec3<f32>) -> vec3<f32> {
    return eye_ray(pixel, depth) + (frame.eye.xyz - origin);
}
