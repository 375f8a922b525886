// Boxes, of which nothing is drawn: the device counts the samples that pass the depth test.
#include "shared/frame.wgsl"

@vertex
fn vertex(@location(0) corner: vec4<f32>) -> @builtin(position) vec4<f32> {
    return frame.view_projection * corner;
}
