// The facing of every triangle, decided once a frame: two bits of two words.
#include "shared/frame.wgsl"
#include "shared/facing.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;
// Of 32 triangles: those that face the light, and those that face away.
@group(1) @binding(2) var<storage, read_write> facings: array<vec2<u32>>;

@compute @workgroup_size(64)
fn find_facings(@builtin(global_invocation_id) at: vec3<u32>) {
    let word = at.x;
    let first = 32u * word;
    let triangles = arrayLength(&indices) / 3u;
    if first >= triangles {
        return;
    }
    let count = min(32u, triangles - first);
    var towards = 0u;
    var away = 0u;
    for (var i = 0u; i < count; i++) {
        let corner = 3u * (first + i);
        let side = facing(
            positions[indices[corner]].xyz,
            positions[indices[corner + 1u]].xyz,
            positions[indices[corner + 2u]].xyz,
            frame.light,
        );
        towards |= select(0u, 1u, side > 0) << i;
        away |= select(0u, 1u, side < 0) << i;
    }
    facings[word] = vec2<u32>(towards, away);
}
