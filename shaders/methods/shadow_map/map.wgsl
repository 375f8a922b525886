// The casters' depth as the light sees it. Twin of `LightView` in src/methods/light_depth.rs.
struct Light {
    // To clip space, from places relative to `origin`. What is nearer to the light has larger depth.
    view_projection: mat4x4<f32>,
    origin: vec4<f32>,
}

@group(0) @binding(0) var<uniform> light: Light;

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return light.view_projection * vec4<f32>(position - light.origin.xyz, 1.0);
}
