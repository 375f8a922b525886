// Holds each triangle's shadow frustum against the trees of boxes, and leaves the tiles that it cuts to `cast_parts`.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/frustum.wgsl"

fn cast_tile(tile: u32, of_caster: Blocker) {
    let corner = corner_of(tile);
    let end = min(corner + TILE, vec2<u32>(frame.picture.xy));
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            darken_if_behind(pixel_at(vec2<u32>(x, y)), of_caster);
        }
    }
}

fn cast_on_tree(triangle: u32, tree: u32, of_caster: Blocker) {
    var node = 0u;
    loop {
        if atomicLoad(&dark[tree + node]) == 0u {
            let side = side_of(nodes[tree + node], of_caster);
            if side == INSIDE {
                atomicStore(&dark[tree + node], 1u);
            } else if side == ACROSS {
                if node < first_tile() {
                    node = 4u * node + 1u;
                    continue;
                }
                let tile = node - first_tile();
                if !leave(Part(triangle, tile)) {
                    cast_tile(tile, of_caster);
                }
            }
        }
        // After the last of four comes what follows the one above.
        while node != 0u && node % 4u == 0u {
            node = (node - 1u) / 4u;
        }
        if node == 0u {
            break;
        }
        node++;
    }
}

@compute @workgroup_size(64)
fn cast_frusta(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let triangle = invocation(at, workgroups);
    if triangle >= arrayLength(&casters) {
        return;
    }
    let of_caster = blocker(casters[triangle], frame.light);
    if of_caster.side == 0.0 {
        return;
    }
    for (var slice = 0u; slice < slices; slice++) {
        cast_on_tree(triangle, slice * tree_size(), of_caster);
    }
}
