// A corner of a shadow volume by its number: see src/methods/corner.rs. All faces of a frame are drawn by one entry point, so
// the same corner has the same bits in all of them.
#include "shared/extrude.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;

// Where the weight of a face begins in the numbers of its corners.
override vertex_bits: u32 = 29u;

fn position_of(vertex: u32, place: u32) -> vec4<f32> {
    let p = positions[vertex].xyz;
    if place == 0u {
        return clip_near(p);
    }
    return clip_far(p, place - 1u);
}

@vertex
fn corner(@builtin(vertex_index) number: u32) -> @invariant @builtin(position) vec4<f32> {
    return position_of(number & 0x1fffffffu, number >> 29u);
}

struct WeightedCorner {
    @invariant @builtin(position) position: vec4<f32>,
    // How often the face counts.
    @location(0) @interpolate(flat) weight: f32,
}

@vertex
fn weighted_corner(@builtin(vertex_index) number: u32) -> WeightedCorner {
    let vertex = extractBits(number, 0u, vertex_bits);
    let weight = extractBits(number, vertex_bits, 29u - vertex_bits) + 1u;
    return WeightedCorner(position_of(vertex, number >> 29u), f32(weight));
}
