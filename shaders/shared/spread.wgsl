// Says how many workgroups there are for what was left, one a part.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/parts.wgsl"

@group(2) @binding(1) var<storage, read_write> workgroups: array<u32, 4>;

// In a row.
const MOST: u32 = 65535u;

@compute @workgroup_size(1)
fn spread() {
    let count = part_count();
    workgroups[0] = min(count, MOST);
    workgroups[1] = (count + MOST - 1u) / MOST;
    workgroups[2] = select(0u, 1u, count > 0u);
}
