// The casters' depth as the light sees it.
struct Light {
    view_projection: mat4x4<f32>,
}

@group(0) @binding(0) var<uniform> light: Light;

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return light.view_projection * vec4<f32>(position, 1.0);
}
