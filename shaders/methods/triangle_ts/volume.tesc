// Tessellation levels of one triangle (Milet et al. 2014, algorithm 1).
//
// INNER_LEVEL 3 makes a smaller triangle inside of the given one, and a ring around it that becomes the
// side quads when the evaluation shader pushes the smaller one away; 1 leaves the triangle alone, the
// front cap. Level 0 discards the patch: the triangle is edge-on to the light.
#include "methods/triangle_ts/corners.glsl"

void main() {
    float outer = hand_on_corners() ? 1.0 : 0.0;
    gl_TessLevelOuter[0] = outer;
    gl_TessLevelOuter[1] = outer;
    gl_TessLevelOuter[2] = outer;
    gl_TessLevelInner[0] = float(INNER_LEVEL);
}
