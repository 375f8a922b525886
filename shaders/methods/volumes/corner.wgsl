// A corner of a shadow volume by its number: see src/methods/portable_volumes.rs. All faces are drawn by this one entry
// point, so the same corner has the same bits in all of them.
#include "shared/extrude.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;

@vertex
fn corner(@builtin(vertex_index) number: u32) -> @invariant @builtin(position) vec4<f32> {
    let p = positions[number & 0x1fffffffu].xyz;
    let place = number >> 29u;
    if place == 0u {
        return clip_near(p);
    }
    return clip_far(p, place - 1u);
}

// What a face adds to a count where it is seen from outside of the volume; from inside it takes it away.
override seen_from_outside: f32 = 1.0;

@fragment
fn count(@builtin(front_facing) is_outside: bool) -> @location(0) f32 {
    return select(-seen_from_outside, seen_from_outside, is_outside);
}
