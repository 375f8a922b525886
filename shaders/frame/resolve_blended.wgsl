// Counts that were blended to shadow mask: see src/frame/blended_counts.rs. The depth test decides whether something is there.
#include "shared/fullscreen.wgsl"
#include "shared/pixel.wgsl"

// One a word, or two.
@group(0) @binding(0) var<storage, read> counts: array<u32>;
// What counting began with.
@group(0) @binding(1) var<uniform> begun_with: vec4<f32>;

// Of a count.
override bits: u32;

@fragment
fn counted(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let pixel = pixel_index(at);
    var count = 0.0;
    if bits == 16u {
        count = unpack2x16float(counts[pixel / 2u])[pixel % 2u];
    } else {
        count = bitcast<f32>(counts[pixel]);
    }
    if count + begun_with.x == 0.0 {
        discard;
    }
    return vec4<f32>(1.0);
}
