// Where the corners of each block go: one list after the other, each in the order of blocks.

// Of each block the number of corners in each list, then where these begin. The last entry is no block's.
@group(1) @binding(0) var<storage, read_write> corners: array<vec4<u32>>;

const PARTS: u32 = 256u;

var<workgroup> of_parts: array<vec4<u32>, PARTS>;

@compute @workgroup_size(PARTS)
fn sum_blocks(@builtin(local_invocation_index) part: u32) {
    let blocks = arrayLength(&corners) - 1u;
    let each = (blocks + PARTS - 1u) / PARTS;
    let first = min(part * each, blocks);
    let end = min(first + each, blocks);
    var sum = vec4<u32>(0u);
    for (var block = first; block < end; block++) {
        sum += corners[block];
    }
    // After each step a part has the sum of twice as many, up to itself.
    of_parts[part] = sum;
    for (var reach = 1u; reach < PARTS; reach *= 2u) {
        workgroupBarrier();
        let below = select(vec4<u32>(0u), of_parts[max(part, reach) - reach], part >= reach);
        workgroupBarrier();
        of_parts[part] += below;
    }
    workgroupBarrier();
    let all = of_parts[PARTS - 1u];
    let before = of_parts[part] - sum;
    var place = before + vec4<u32>(0u, all.x, all.x + all.y, all.x + all.y + all.z);
    for (var block = first; block < end; block++) {
        let count = corners[block];
        corners[block] = place;
        place += count;
    }
    if part == PARTS - 1u {
        corners[blocks] = place;
    }
}
