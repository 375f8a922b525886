// Pushes the front cap to the far plane (Milet et al. 2014, section 2.1): a caster is in the depth buffer
// itself, so its front cap is never in front of what is visible.
#include "methods/volumes/count.glsl"

layout(location = 0) in float farness;
#ifdef STANDARD_DEPTH
#define FAR 1.0
layout(depth_greater) out float gl_FragDepth;
#else
#define FAR 0.0
layout(depth_less) out float gl_FragDepth;
#endif

void main() {
    // Constant 0 on the front cap. On a side, at its near edge, it may round to 0 as well, but changes from
    // pixel to pixel.
    float change = fwidth(farness); // outside of any branch, where derivatives are undefined
    bool on_front_cap = farness == 0.0 && change == 0.0;
    gl_FragDepth = on_front_cap ? FAR : gl_FragCoord.z;
#ifdef OUTSIDE_ADDS
    count();
#endif
}
