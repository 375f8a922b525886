// Says how many workgroups `cover_parts` needs.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/alias_free_map/light_map.wgsl"

@group(2) @binding(0) var<storage, read> parts: array<u32>;
@group(2) @binding(1) var<storage, read_write> workgroups: array<u32, 4>;

// In a row.
const MOST: u32 = 65535u;

@compute @workgroup_size(1)
fn spread() {
    let count = min(parts[0], (arrayLength(&parts) - 2u) / 2u);
    let rows = (count + MOST - 1u) / MOST;
    workgroups[0] = min(count, MOST);
    workgroups[1] = rows;
    workgroups[2] = select(0u, 1u, count > 0u);
}
