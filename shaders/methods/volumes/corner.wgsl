// A corner of a shadow volume by its number: twice that of the vertex, and one more for the far end of its shadow. All
// faces are drawn by this one entry point, so the same corner has the same bits in all of them.
#include "shared/extrude.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;

@vertex
fn corner(@builtin(vertex_index) number: u32) -> @invariant @builtin(position) vec4<f32> {
    let p = positions[number >> 1u].xyz;
    if (number & 1u) == 0u {
        return clip_near(p);
    }
    return clip_far(p);
}
