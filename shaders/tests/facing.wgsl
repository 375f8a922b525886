// The facing of each case, as WGSL computes it.
#include "shared/facing.wgsl"

@group(0) @binding(0) var<storage, read> cases: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read_write> results: array<i32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = id.x + id.y * groups.x * 64u;
    if i < arrayLength(&results) {
        results[i] = facing(cases[4u * i].xyz, cases[4u * i + 1u].xyz, cases[4u * i + 2u].xyz, cases[4u * i + 3u]);
    }
}
