// What follows from which triangle a pixel shows: the shadow mask before any method, depth beside edges, and shading.
//
// The mask: surfaces whose visible side faces away from the light need no shadow to be dark, and no method need find
// them. Shadow volumes could not always: the side quads of a surface that the light sees nearly edge-on lie in its own
// plane, to the last bit of depth, and their order is then a matter of luck.
//
// Depth: that of a lit side is moved to the right side of the light planes through its own edges.
//
// Shadow volumes start from edges of the very triangle that a pixel shows, and close to such an edge the
// depth buffer cannot always tell the surface from the side quad. A rasteriser snaps vertices to its grid, so a
// pixel may show a triangle that its centre just misses; depth then comes from the plane beyond the edge, where
// surface and side quad have changed places. And where the light grazes the surface, both are in one plane but
// for the last bits of depth. Which of the two comes first along the line of sight is known without any depth:
// the surface lies on the triangle's side of the light plane, and so does the eye, or not.
#include "shared/frame.wgsl"
#include "shared/facing.wgsl"
#include "shared/fullscreen.wgsl"
#include "shared/pixel.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;
@group(2) @binding(0) var<storage, read> triangle_ids: array<u32>;
@group(2) @binding(1) var<storage, read_write> surfaces: array<u32>;
// Where a surface is to be moved.
@group(2) @binding(2) var<storage, read_write> moved_depths: array<f32>;

// More than any depth: it stays as it is.
const UNMOVED: f32 = 2.0;

// How far a snapped vertex may be from its place, as part of a pixel: half a step of the grid.
const SNAP_PX: f32 = 1.0 / 512.0;

// How far apart surface and side quad must be for the rasteriser's arithmetic to tell them apart, as part of the
// distance: eight times the last bit of a float. Less leaves side quads before surfaces that the light grazes,
// and more moves surfaces past side quads of other edges.
const ROUNDING: f32 = 1e-6;

// Edges whose light plane is farther from the surface than this part of the distance are not in question.
const NEAR_SURFACE: f32 = 0.01;

// The line of sight through a pixel's centre. A point of it is the eye plus w times `ray`, where w is its
// distance before the eye; `ray_dx` and `ray_dy` are how the ray changes from one pixel to the next.
struct Sight {
    ray: vec3<f32>,
    ray_dx: vec3<f32>,
    ray_dy: vec3<f32>,
}

fn sight_through(pixel: vec2<f32>) -> Sight {
    let ndc = vec2<f32>(2.0 * pixel.x / frame.picture.x - 1.0, 1.0 - 2.0 * pixel.y / frame.picture.y);
    let m = frame.clip_to_eye_ray;
    return Sight(
        (m * vec4<f32>(ndc, 0.0, 1.0)).xyz,
        m[0].xyz * (2.0 / frame.picture.x),
        m[1].xyz * (-2.0 / frame.picture.y),
    );
}

// Where a plane meets the line of sight: w there, and its change from pixel to pixel.
struct Crossing {
    w: f32,
    slope: vec2<f32>,
    // Whether the ray comes out on the side that the normal points to.
    along_normal: bool,
}

fn crossing(sight: Sight, normal: vec3<f32>, point: vec3<f32>) -> Crossing {
    let along = dot(normal, sight.ray);
    let w = dot(normal, point - frame.eye.xyz) / along;
    let change = vec2<f32>(dot(normal, sight.ray_dx), dot(normal, sight.ray_dy));
    return Crossing(w, -w * change / along, along > 0.0);
}

// Narrows the range of w in which the surface is on the triangle's side of the light plane through its edge from a
// to b. `side` is the triangle's facing.
fn narrow(range: vec2<f32>, sight: Sight, surface: Crossing, a: vec3<f32>, b: vec3<f32>, side: i32) -> vec2<f32> {
    // Points to the triangle's side.
    let normal = cross(frame.light.xyz - a * frame.light.w, b - a) * f32(side);
    let plane = crossing(sight, normal, a);
    // Not so either where the light plane is edge-on to the eye, and w not a number.
    if !(abs(plane.w - surface.w) < NEAR_SURFACE * surface.w) {
        return range;
    }
    let apart = abs(surface.slope - plane.slope);
    let margin = SNAP_PX * (apart.x + apart.y) + ROUNDING * surface.w;
    if plane.along_normal {
        return vec2<f32>(max(range.x, plane.w + margin), range.y);
    }
    return vec2<f32>(range.x, min(range.y, plane.w - margin));
}

// The depth of a lit side whose own edges leave it no other, else UNMOVED.
fn moved_depth(sight: Sight, surface: Crossing, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, side: i32) -> f32 {
    var range = vec2<f32>(0.0, 3e38);
    range = narrow(range, sight, surface, a, b, side);
    range = narrow(range, sight, surface, b, c, side);
    range = narrow(range, sight, surface, c, a, side);
    let w = clamp(surface.w, range.x, range.y);
    if range.x > range.y || !(w < surface.w || w > surface.w) {
        return UNMOVED;
    }
    return depth_at(w);
}

// The mask: 1 on dark sides.
@fragment
fn visible_triangles(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = pixel_index(at);
    let id = triangle_ids[pixel];
    if id == 0u {
        surfaces[pixel] = NO_SURFACE;
        return vec4<f32>(0.0);
    }
    let first = 3u * (id - 1u);
    let a = positions[indices[first]].xyz;
    let b = positions[indices[first + 1u]].xyz;
    let c = positions[indices[first + 2u]].xyz;
    let sorted = sort_corners(a, b, c);
    let side = sorted_facing(sorted, frame.light);
    // Of eye and light: -1 where they are on different sides of the triangle's plane.
    let sides = side * sorted_facing(sorted, frame.eye);
    let sight = sight_through(at.xy);
    let normal = cross(b - a, c - a);
    let surface = crossing(sight, normal, a);
    var depth = UNMOVED;
    if sides > 0 {
        depth = moved_depth(sight, surface, a, b, c, side);
    }
    // Squares of a tiny triangle's normal would underflow.
    let scaled = normal / max(max(abs(normal.x), abs(normal.y)), abs(normal.z));
    let towards_eye = select(scaled, -scaled, surface.along_normal) * inverseSqrt(dot(scaled, scaled));
    let to_light = frame.light.xyz - (frame.eye.xyz + sight.ray * surface.w) * frame.light.w;
    let cosine = dot(towards_eye, to_light) * inverseSqrt(dot(to_light, to_light));
    var surface_word = pack2x16snorm(vec2<f32>(towards_eye.y, cosine)) & ~IS_MOVED;
    if depth != UNMOVED {
        surface_word |= IS_MOVED;
        moved_depths[pixel] = depth;
    }
    surfaces[pixel] = surface_word;
    return vec4<f32>(select(0.0, 1.0, sides < 0));
}
