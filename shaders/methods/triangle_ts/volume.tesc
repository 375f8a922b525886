// Tessellation levels of one triangle (Milet et al. 2014, algorithm 1).
//
// INNER_LEVEL 3 makes a smaller triangle inside of the given one, and a ring around it that becomes the
// side quads when the evaluation shader pushes the smaller one away; 1 leaves the triangle alone, the
// front cap. Level 0 discards the patch: the triangle is edge-on to the light.
//
// The paper's outer level is 1. At 2 an edge has a middle, which the evaluation shader puts on one of its ends: a
// tessellator begins the triangles of the two halves of an edge with a point of the edge, but the one triangle of
// a whole edge with a point of the smaller triangle. That would be the far end of a long thin triangle, whose
// depth then loses digits by cancellation (see silhouette_ts/sides.tese).
#include "methods/triangle_ts/corners.glsl"

#if INNER_LEVEL == 1
const float OUTER_LEVEL = 1.0;
#else
const float OUTER_LEVEL = 2.0;
#endif

void main() {
    float outer = hand_on_corners() ? OUTER_LEVEL : 0.0;
    gl_TessLevelOuter[0] = outer;
    gl_TessLevelOuter[1] = outer;
    gl_TessLevelOuter[2] = outer;
    gl_TessLevelInner[0] = float(INNER_LEVEL);
}
