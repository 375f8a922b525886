// Tessellation levels of one edge from its multiplicity m (Milet et al. 2014, algorithms 2 to 4).
//
// A row of 2|m| - 1 quads, of which every second one is bent to nothing by the evaluation shader,
// leaves |m| side quads. Level 0 discards the patch: the edge is no silhouette.
#include "methods/silhouette/edge.glsl"

layout(vertices = 1) out;
layout(location = 0) flat in uint number[];
layout(location = 0) patch out vec3 patch_a;
layout(location = 1) patch out vec3 patch_b;
layout(location = 2) patch out int patch_quads;

void main() {
    uvec4 edge = edges[number[0]];
    vec3 a = positions[edge.x].xyz;
    vec3 b = positions[edge.y].xyz;
    int m = multiplicity(edge, a, b);
    // The evaluation shader winds for m > 0; swapped ends turn the winding.
    patch_a = m > 0 ? a : b;
    patch_b = m > 0 ? b : a;
    patch_quads = 2 * abs(m) - 1;
    float across = m == 0 ? 0.0 : 1.0;
    float along = m == 0 ? 0.0 : float(patch_quads);
    gl_TessLevelOuter[0] = across;
    gl_TessLevelOuter[1] = along;
    gl_TessLevelOuter[2] = across;
    gl_TessLevelOuter[3] = along;
    gl_TessLevelInner[0] = along;
    gl_TessLevelInner[1] = across;
}
