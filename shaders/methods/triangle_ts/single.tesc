// Tessellation levels of one triangle whose whole shadow volume comes from one patch (Milet et al. 2014,
// section 2.1 and figure 3): a row of five quads. Level 0 discards the patch: the triangle is edge-on to
// the light.
#include "shared/frame.glsl"
#include "shared/facing.glsl"

layout(vertices = 1) out;
layout(location = 0) in vec3 position[];
// Wound so that they look counter-clockwise from the light.
layout(location = 0) patch out vec3 corners[3];

void main() {
    int side = facing(position[0], position[1], position[2], frame.light);
    corners[0] = position[0];
    corners[1] = side < 0 ? position[2] : position[1];
    corners[2] = side < 0 ? position[1] : position[2];
    float across = side == 0 ? 0.0 : 1.0;
    gl_TessLevelOuter[0] = across;
    gl_TessLevelOuter[1] = 5.0;
    gl_TessLevelOuter[2] = across;
    gl_TessLevelOuter[3] = 5.0;
    gl_TessLevelInner[0] = 5.0;
    // Becomes 3 in the tessellator, with two rows without height: with fractional odd spacing, a level of 1
    // beside a larger one is taken as a little more than 1.
    gl_TessLevelInner[1] = 1.0;
}
