// Adds to the shadow mask what the cube map says: of a square of texels around the nearest one, the part
// that is nearer to the light (percentage-closer filtering, Reeves, Salesin and Cook 1987).
#include "shared/frame.wgsl"
#include "shared/fullscreen.wgsl"
#include "methods/shadow_map/bias.wgsl"

struct Cube {
    // Of each face: x right and y up in world space, and the direction that it looks in.
    right: array<vec4<f32>, 6>,
    up: array<vec4<f32>, 6>,
    forward: array<vec4<f32>, 6>,
    // Where the light is; w: distance of the near plane of every face.
    light: vec4<f32>,
    rounding: vec4<f32>,
}

@group(1) @binding(0) var depth: texture_depth_2d;
@group(1) @binding(1) var map: texture_depth_2d_array;
@group(1) @binding(2) var<uniform> cube: Cube;

// Side of the square, odd.
override pcf: i32 = 1;

// The face that a direction is seen on: the one that it goes farthest in the direction of.
fn face_of(direction: vec3<f32>) -> i32 {
    var face = 0;
    var farthest = dot(direction, cube.forward[0].xyz);
    for (var i = 1; i < 6; i++) {
        let along = dot(direction, cube.forward[i].xyz);
        if along > farthest {
            face = i;
            farthest = along;
        }
    }
    return face;
}

// Where a direction is seen on a face: in texels from the top left.
fn place_on(face: i32, direction: vec3<f32>, size: f32) -> vec2<f32> {
    let window = vec2<f32>(dot(direction, cube.right[face].xyz), dot(direction, cube.up[face].xyz));
    let ndc = window / dot(direction, cube.forward[face].xyz);
    return vec2<f32>(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * size;
}

// Whether the map has something nearer than a point, given from the light, by more than `bias`. Reversed depth:
// what is nearer is larger.
fn is_nearer(face: i32, texel: vec2<i32>, from_light: vec3<f32>, bias: f32) -> bool {
    let distance = dot(from_light, cube.forward[face].xyz) - bias;
    return distance > 0.0 && cube.light.w / distance < textureLoad(map, texel, face, 0);
}

@fragment
fn lookup(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let depth_here = textureLoad(depth, vec2<i32>(at.xy), 0);
    if is_background(depth_here) {
        discard;
    }
    let from_light = relative_position(at.xy, depth_here, cube.light.xyz);
    let face = face_of(from_light);
    let distance = dot(from_light, cube.forward[face].xyz);
    let bias = rounding_distance(cube.rounding.xy);
    let size = f32(textureDimensions(map).x);
    // On the rim of a face, rounding may step over.
    let nearest = vec2<i32>(clamp(place_on(face, from_light, size), vec2<f32>(0.0), vec2<f32>(size - 1.0)));
    let reach = pcf / 2;
    var shadowed = 0;
    for (var y = -reach; y <= reach; y++) {
        for (var x = -reach; x <= reach; x++) {
            let texel = nearest + vec2<i32>(x, y);
            if all(texel >= vec2<i32>(0)) && all(texel < vec2<i32>(i32(size))) {
                shadowed += i32(is_nearer(face, texel, from_light, bias));
            } else {
                // Over the rim the square goes on, in the plane of this face, on the next one.
                let ndc = (vec2<f32>(texel) + 0.5) / size * 2.0 - 1.0;
                let beside = distance
                    * (cube.forward[face].xyz + ndc.x * cube.right[face].xyz - ndc.y * cube.up[face].xyz);
                let next = face_of(beside);
                let there = clamp(place_on(next, beside, size), vec2<f32>(0.0), vec2<f32>(size - 1.0));
                shadowed += i32(is_nearer(next, vec2<i32>(there), beside, bias));
            }
        }
    }
    return vec4<f32>(f32(shadowed) / f32(pcf * pcf));
}
