// Writes the pixels of each cell's list next to each other.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/view_sample.wgsl"
#include "methods/alias_free_map/light_map.wgsl"

@group(2) @binding(0) var<storage, read> ways: array<SampleWay>;
@group(2) @binding(1) var<storage, read> cells: array<u32>;
// Each with how many samples of its cell came before.
@group(2) @binding(2) var<storage, read> points: array<SamplePoint>;
// Each with its pixel.
@group(2) @binding(3) var<storage, read_write> sorted: array<SamplePoint>;

@compute @workgroup_size(8, 8)
fn sort_samples(@builtin(global_invocation_id) at: vec3<u32>) {
    if any(at.xy >= vec2<u32>(frame.picture.xy)) {
        return;
    }
    let pixel = pixel_at(at.xy);
    let place = ways[pixel].place;
    if place != 0u {
        let point = points[pixel];
        sorted[cells[place - 1u] + point.word] = SamplePoint(point.at, pixel);
    }
}
