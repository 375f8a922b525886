// Makes the boxes of tiles.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/blocks.wgsl"
#include "shared/view_sample.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(0) var<storage, read_write> samples: array<ViewSample>;
@group(2) @binding(1) var<storage, read_write> nodes: array<Node>;

const NOTHING: Node = Node(vec3<f32>(3e38), 0.0, vec3<f32>(-3e38), 0u);

// What rounding a point moves it by, as a part of its largest coordinate.
const ROUNDING: f32 = 1.0 / 4194304.0;

@compute @workgroup_size(64)
fn bound_tiles(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let tile = invocation(at, workgroups);
    if tile >= tiles * tiles {
        return;
    }
    var boxes: array<Node, MOST_SLICES>;
    for (var slice = 0u; slice < slices; slice++) {
        boxes[slice] = NOTHING;
    }
    let corner = corner_of(tile);
    let end = min(corner + TILE, vec2<u32>(frame.picture.xy));
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            let pixel = pixel_at(vec2<u32>(x, y));
            let sample = samples[pixel];
            if sample.place == 0u {
                continue;
            }
            let point = sample.corner + sample.way;
            let size = abs(point);
            let rounding = ROUNDING * max(size.x, max(size.y, size.z));
            var slice = 0u;
            if slices > 1u {
                slice = slice_of(point);
                samples[pixel].place = 1u + slice;
            }
            let before = boxes[slice];
            let low = min(before.low, point - rounding);
            let high = max(before.high, point + rounding);
            boxes[slice] = Node(low, max(before.uncertainty, sample.uncertainty), high, 0u);
        }
    }
    for (var slice = 0u; slice < slices; slice++) {
        nodes[slice * tree_size() + first_tile() + tile] = boxes[slice];
    }
}
