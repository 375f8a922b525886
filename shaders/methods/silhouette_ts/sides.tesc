// Tessellation levels of one edge from its multiplicity m (Milet et al. 2014, algorithms 2 to 4).
//
// A row of 2|m| - 1 quads, of which every second one is bent to nothing by the evaluation shader, leaves
// |m| side quads. Level 0 discards the patch: the edge is no silhouette. WEIGHTED: one quad, which counts |m| times.
#include "methods/silhouette/edge.glsl"

layout(vertices = 1) out;
layout(location = 0) patch out vec3 patch_a;
layout(location = 1) patch out vec3 patch_b;
layout(location = 2) patch out int patch_multiplicity;

void main() {
    Edge edge = load_edge();
    int m = edge.multiplicity;
    patch_a = edge.a;
    patch_b = edge.b;
    patch_multiplicity = m;
#ifdef WEIGHTED
    float along = m == 0 ? 0.0 : 1.0;
#else
    float along = m == 0 ? 0.0 : float(2 * abs(m) - 1);
#endif
    float across = m == 0 ? 0.0 : 1.0;
    gl_TessLevelOuter[0] = across;
    gl_TessLevelOuter[1] = along;
    gl_TessLevelOuter[2] = across;
    gl_TessLevelOuter[3] = along;
    gl_TessLevelInner[0] = along;
    // The paper's 1 becomes 2 in the tessellator as soon as another level is above 1. Asking for 2 gives
    // a middle row to every patch, by which the evaluation shader has a say in how quads are cut.
    gl_TessLevelInner[1] = 2.0;
}
