// Brings the shadow of whole nodes to their pixels, and finds the tiles that have no other pixels left.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/view_sample.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(0) var<storage, read> ways: array<SampleWay>;
@group(2) @binding(1) var<storage, read_write> dark: array<u32>;

fn is_all_dark(tree: u32, tile: u32) -> bool {
    var node = first_tile() + tile;
    while node != 0u && dark[tree + node] == 0u {
        node = (node - 1u) / 4u;
    }
    return dark[tree + node] != 0u;
}

@compute @workgroup_size(64)
fn darken_tiles(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let tile = invocation(at, workgroups);
    if tile >= tiles * tiles {
        return;
    }
    // A bit for each slice.
    var in_shadow = 0u;
    for (var slice = 0u; slice < slices; slice++) {
        in_shadow |= select(0u, 1u, is_all_dark(slice * tree_size(), tile)) << slice;
    }
    var is_lit = 0u;
    let corner = corner_of(tile);
    let end = min(corner + TILE, vec2<u32>(frame.picture.xy));
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            let pixel = pixel_at(vec2<u32>(x, y));
            let place = ways[pixel].place;
            if place == 0u || is_dark(pixel) {
                continue;
            }
            if (in_shadow >> (place - 1u) & 1u) != 0u {
                darken(pixel);
            } else {
                is_lit |= 1u << (place - 1u);
            }
        }
    }
    for (var slice = 0u; slice < slices; slice++) {
        dark[slice * tree_size() + first_tile() + tile] = select(1u, 0u, (is_lit >> slice & 1u) != 0u);
    }
}
