// Stencil count to shadow mask. The stencil test (the count is not 0) and the depth test (something is
// there) decide which pixels get here.
#include "shared/fullscreen.wgsl"

@fragment
fn counted() -> @location(0) vec4<f32> {
    return vec4<f32>(1.0);
}
