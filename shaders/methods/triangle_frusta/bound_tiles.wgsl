// Makes the boxes of tiles.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/view_sample.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(0) var<storage, read> corners: array<SampleCorner>;
@group(2) @binding(1) var<storage, read_write> ways: array<SampleWay>;
@group(2) @binding(2) var<storage, read_write> centres: array<NodeCentre>;
@group(2) @binding(3) var<storage, read_write> extents: array<NodeExtent>;

struct Range {
    low: vec3<f32>,
    high: vec3<f32>,
    uncertainty: f32,
}

const NOTHING: Range = Range(vec3<f32>(3e38), vec3<f32>(-3e38), 0.0);

@compute @workgroup_size(64)
fn bound_tiles(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let tile = invocation(at, workgroups);
    if tile >= tiles * tiles {
        return;
    }
    var ranges: array<Range, MOST_SLICES>;
    for (var slice = 0u; slice < slices; slice++) {
        ranges[slice] = NOTHING;
    }
    let corner = corner_of(tile);
    let end = min(corner + TILE, vec2<u32>(frame.picture.xy));
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            let pixel = pixel_at(vec2<u32>(x, y));
            let way = ways[pixel];
            if way.place == 0u {
                continue;
            }
            let sample = corners[pixel];
            let point = sample.corner + way.way;
            var slice = 0u;
            if slices > 1u {
                slice = slice_of(point);
                ways[pixel].place = 1u + slice;
            }
            let before = ranges[slice];
            let uncertainty = max(before.uncertainty, sample.uncertainty);
            ranges[slice] = Range(min(before.low, point), max(before.high, point), uncertainty);
        }
    }
    for (var slice = 0u; slice < slices; slice++) {
        let its = ranges[slice];
        let node = node_of(its.low, its.high, its.uncertainty);
        let index = slice * tree_size() + first_tile() + tile;
        centres[index] = node.centre;
        extents[index] = node.extent;
    }
}
