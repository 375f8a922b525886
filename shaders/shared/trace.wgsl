// A shadow ray a pixel; `is_blocked` says whether it meets anything.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "shared/point_seen.wgsl"

@compute @workgroup_size(8, 8)
fn trace(@builtin(global_invocation_id) at: vec3<u32>) {
    let id = asked_triangle(at.xy);
    if id != 0u && is_blocked(point_seen(at.xy, id)) {
        darken(pixel_at(at.xy));
    }
}
