// Leaves out the draws of casters that are hidden. Twin of src/methods/occlusion_gpu.rs.

// Of a caster that is drawn in any case.
const ALWAYS: u32 = 0xffffffffu;

// How many samples of each box passed, in 64 bits.
@group(0) @binding(0) var<storage, read> answers: array<vec2<u32>>;
// The box of each caster.
@group(0) @binding(1) var<storage, read> query_of: array<u32>;
// Of each draw: elements, instances, first element, and two that are 0.
@group(0) @binding(2) var<storage, read_write> draws: array<array<u32, 5>>;

@compute @workgroup_size(64)
fn conditional_draws(@builtin(global_invocation_id) id: vec3<u32>) {
    let caster = id.x;
    if caster >= arrayLength(&query_of) { return; }
    let query = query_of[caster];
    if query == ALWAYS { return; }
    let answer = answers[query];
    if (answer.x | answer.y) == 0u { draws[caster][1] = 0u; }
}
