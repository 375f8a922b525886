// The point of a triangle that a pixel shows: the twin of `points_seen` in src/geometry/rays/packet.rs and of
// src/geometry/rays/sight.rs. Needs shared/frame.wgsl.
#include "shared/blocks.wgsl"

// The whole scene.
@group(2) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(2) @binding(1) var<storage, read> indices: array<u32>;

const LEAST_POSITIVE: f32 = 1.2e-38;

// Six times the volume of the tetrahedron of an edge, the eye, and a piece of the line of sight.
fn sight_volume(p: vec3<f32>, q: vec3<f32>, sight: vec3<f32>) -> f32 {
    return dot(cross(q - p, frame.eye.xyz - p), sight);
}

// The part of a vector across a direction of length 1.
fn across(v: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    return v - dot(v, direction) * direction;
}

// How far along an edge it is nearest to a ray from the origin, and the tangent of the angle between the two.
fn nearest_on_edge(start: vec3<f32>, end: vec3<f32>, direction: vec3<f32>) -> vec2<f32> {
    let along = across(end - start, direction);
    let offset = across(start, direction);
    let share = clamp(-dot(offset, along) / max(dot(along, along), LEAST_POSITIVE), 0.0, 1.0);
    let point = start + share * (end - start);
    let distance = dot(point, direction);
    let tangent = length(across(point, direction)) / distance;
    return vec2<f32>(share, select(3e38, tangent, distance > 0.0));
}

// The point of a triangle's edges nearest to a line of sight, as weights of the second and the third corner.
fn nearest_on_edges(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, sight: vec3<f32>) -> vec2<f32> {
    let eye = frame.eye.xyz;
    let direction = normalize(sight);
    let ab = nearest_on_edge(a - eye, b - eye, direction);
    let bc = nearest_on_edge(b - eye, c - eye, direction);
    let ac = nearest_on_edge(a - eye, c - eye, direction);
    if ab.y <= min(bc.y, ac.y) {
        return vec2<f32>(ab.x, 0.0);
    }
    return select(vec2<f32>(0.0, ac.x), vec2<f32>(1.0 - bc.x, bc.x), bc.y <= ac.y);
}

// Where the line of sight through a pixel's centre meets the triangle of this number plus 1, or comes nearest to it if it
// misses it, since a rasteriser has moved its corners a little.
fn point_seen(at: vec2<u32>, id: u32) -> SurfacePoint {
    let first = 3u * (id - 1u);
    let a = positions[indices[first]].xyz;
    let b = positions[indices[first + 1u]].xyz;
    let c = positions[indices[first + 2u]].xyz;
    let centre = vec2<f32>(at) + 0.5;
    let ndc = vec2<f32>(2.0 * centre.x / frame.picture.x - 1.0, 1.0 - 2.0 * centre.y / frame.picture.y);
    let sight = (frame.clip_to_eye_ray * vec4<f32>(ndc, 0.0, 1.0)).xyz;
    let volumes = vec3<f32>(sight_volume(b, c, sight), sight_volume(c, a, sight), sight_volume(a, b, sight));
    let shares = volumes * select(-1.0, 1.0, volumes.x + volumes.y + volumes.z > 0.0);
    let sum = max(shares.x + shares.y + shares.z, LEAST_POSITIVE);
    var weights = shares.yz / sum;
    if min(shares.x, min(shares.y, shares.z)) < 0.0 {
        weights = nearest_on_edges(a, b, c, sight);
    }
    return surface_point(a, b, c, weights);
}
