// Adds to the shadow mask what the cube map says: nearest texel, one comparison a pixel.
#include "shared/frame.wgsl"
#include "shared/fullscreen.wgsl"

struct Cube {
    // Of each face: x right and y up in world space, and the direction that it looks in.
    right: array<vec4<f32>, 6>,
    up: array<vec4<f32>, 6>,
    forward: array<vec4<f32>, 6>,
    // Where the light is; w: distance of the near plane of every face.
    light: vec4<f32>,
}

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var map: texture_depth_2d_array;
@group(1) @binding(2) var<uniform> cube: Cube;

@fragment
fn lookup(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let depth_here = textureLoad(depth, vec2<i32>(at.xy), 0);
    if depth_here == 0.0 {
        discard;
    }
    let from_light = surface_position(at.xy, depth_here) - cube.light.xyz;
    // The face that it is seen on: the one whose direction it goes farthest in.
    var face = 0;
    var distance = dot(from_light, cube.forward[0].xyz);
    for (var i = 1; i < 6; i++) {
        let along = dot(from_light, cube.forward[i].xyz);
        if along > distance {
            face = i;
            distance = along;
        }
    }
    let ndc = vec2<f32>(dot(from_light, cube.right[face].xyz), dot(from_light, cube.up[face].xyz)) / distance;
    let size = vec2<f32>(textureDimensions(map));
    let texel = vec2<f32>(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * size;
    // On the rim of a face, rounding may step over.
    let inside = vec2<i32>(clamp(texel, vec2<f32>(0.0), size - 1.0));
    // Reversed depth: what is nearer to the light is larger.
    if cube.light.w / distance >= textureLoad(map, inside, face, 0) {
        discard;
    }
    return vec4<f32>(1.0);
}
