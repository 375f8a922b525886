// Surfaces that need no shadow to be dark.
#include "shared/frame.wgsl"
#include "shared/facing.wgsl"

@group(1) @binding(0) var<storage, read> positions: array<vec4<f32>>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;

// Whether the visible side of a triangle (its number plus 1, as the G-buffer has it) faces away from
// the light: eye and light are on different sides of its plane.
fn shows_dark_side(id: u32) -> bool {
    let first = 3u * (id - 1u);
    let a = positions[indices[first]].xyz;
    let b = positions[indices[first + 1u]].xyz;
    let c = positions[indices[first + 2u]].xyz;
    return facing(a, b, c, frame.light) * facing(a, b, c, frame.eye) < 0;
}
