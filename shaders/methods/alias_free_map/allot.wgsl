// Makes of the counts of a tile's cells where their lists begin, one after another, and says where the last ends.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/alias_free_map/light_map.wgsl"

@group(2) @binding(0) var<storage, read_write> cells: array<u32>;
// How much is taken.
@group(2) @binding(1) var<storage, read_write> taken: atomic<u32>;

@compute @workgroup_size(64)
fn allot(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let first = TILE_WORDS * invocation(at, workgroups);
    let end = first + TILE_END;
    if end >= arrayLength(&cells) || cells[end + REACH] == 0u {
        return;
    }
    var sum = 0u;
    for (var cell = first; cell < end; cell += CELL_WORDS) {
        sum += cells[cell];
    }
    var begin = atomicAdd(&taken, sum);
    for (var cell = first; cell < end; cell += CELL_WORDS) {
        let count = cells[cell];
        cells[cell] = begin;
        begin += count;
    }
    cells[end] = begin;
}
