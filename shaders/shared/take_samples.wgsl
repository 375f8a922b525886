// Writes what a picture shows at each pixel: see src/methods/view_samples.rs.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/point_seen.wgsl"
#include "shared/view_sample.wgsl"

@group(2) @binding(2) var<storage, read_write> corners: array<SampleCorner>;
@group(2) @binding(3) var<storage, read_write> ways: array<SampleWay>;
// Their points again, to be read at a first look, and a number that methods set.
@group(2) @binding(4) var<storage, read_write> points: array<SamplePoint>;

@compute @workgroup_size(8, 8)
fn take_samples(@builtin(global_invocation_id) at: vec3<u32>) {
    if any(at.xy >= vec2<u32>(frame.picture.xy)) {
        return;
    }
    let pixel = pixel_at(at.xy);
    let id = asked_triangle(at.xy);
    if id == 0u {
        ways[pixel].place = 0u;
        return;
    }
    let point = point_seen(at.xy, id);
    points[pixel] = SamplePoint(point.corner + point.way, 0u);
    corners[pixel] = SampleCorner(point.corner, point.uncertainty);
    ways[pixel] = SampleWay(point.way, 1u);
}
