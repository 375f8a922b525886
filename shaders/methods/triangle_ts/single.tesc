// Tessellation levels of one triangle whose whole shadow volume comes from one patch (Milet et al. 2014,
// section 2.1 and figure 3): a row of five quads. Level 0 discards the patch: the triangle is edge-on to
// the light.
#include "methods/triangle_ts/corners.glsl"

void main() {
    float across = hand_on_corners() ? 1.0 : 0.0;
    gl_TessLevelOuter[0] = across;
    gl_TessLevelOuter[1] = 5.0;
    gl_TessLevelOuter[2] = across;
    gl_TessLevelOuter[3] = 5.0;
    gl_TessLevelInner[0] = 5.0;
    // Becomes 3 in the tessellator, with two rows without height: with fractional odd spacing, a level of 1
    // beside a larger one is taken as a little more than 1.
    gl_TessLevelInner[1] = 1.0;
}
