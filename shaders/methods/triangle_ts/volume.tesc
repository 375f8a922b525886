// Tessellation levels of one triangle (Milet et al. 2014, algorithm 1).
//
// INNER_LEVEL 3 makes a smaller triangle inside of the given one, and a ring around it that becomes the
// side quads when the evaluation shader pushes the smaller one away; 1 leaves the triangle alone, the
// front cap. Level 0 discards the patch: the triangle is edge-on to the light.
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
    float outer = side == 0 ? 0.0 : 1.0;
    gl_TessLevelOuter[0] = outer;
    gl_TessLevelOuter[1] = outer;
    gl_TessLevelOuter[2] = outer;
    gl_TessLevelInner[0] = float(INNER_LEVEL);
}
