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
