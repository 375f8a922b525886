// Brings the shadow of whole nodes to their pixels.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/blocks.wgsl"
#include "shared/view_sample.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(0) var<storage, read> samples: array<ViewSample>;
@group(2) @binding(1) var<storage, read> dark: array<u32>;

fn is_all_dark(tree: u32, tile: u32) -> bool {
    var node = first_tile() + tile;
    while node != 0u && dark[tree + node] == 0u {
        node = (node - 1u) / 4u;
    }
    return dark[tree + node] != 0u;
}

@compute @workgroup_size(64)
fn darken_tiles(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let number = invocation(at, workgroups);
    let tile = number % (tiles * tiles);
    let slice = number / (tiles * tiles);
    if slice >= slices || !is_all_dark(slice * tree_size(), tile) {
        return;
    }
    let corner = corner_of(tile);
    let end = min(corner + TILE, vec2<u32>(frame.picture.xy));
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            let pixel = pixel_at(vec2<u32>(x, y));
            let sample = samples[pixel];
            if sample.place != 0u && (slices == 1u || slice_of(sample.corner + sample.way) == slice) {
                darken(pixel);
            }
        }
    }
}
