// The shadow mask before any method: surfaces whose visible side faces away from the light.
//
// They need no shadow to be dark, and no method need find them. Shadow volumes could not always: the side
// quads of a surface that the light sees nearly edge-on lie in its own plane, to the last bit of depth,
// and their order is then a matter of luck.
#include "shared/frame.wgsl"
#include "shared/facing.wgsl"
#include "shared/fullscreen.wgsl"
#include "shared/visible_triangle.wgsl"

@fragment
fn dark_sides(@builtin(position) at: vec4<f32>) -> @location(0) vec4<f32> {
    let id = visible_id(at.xy);
    if id == 0u {
        return vec4<f32>(0.0);
    }
    let t = triangle_of(id);
    // Eye and light on different sides of the triangle's plane.
    let is_dark = facing(t.a, t.b, t.c, frame.light) * facing(t.a, t.b, t.c, frame.eye) < 0;
    return vec4<f32>(select(0.0, 1.0, is_dark));
}
