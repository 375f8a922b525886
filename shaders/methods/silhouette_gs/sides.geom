// The side quads of one edge: |multiplicity| copies, wound after its sign; or, WEIGHTED, one that counts as often.
//
// MAX_MULTIPLICITY: most opposite vertices that an edge may have.
#include "shared/extrude.glsl"
#include "methods/volumes/side_quad.glsl"

#ifndef PATCH_OPPOSITES
layout(points) in;
#elif PATCH_OPPOSITES == 2
layout(lines_adjacency) in;
#else
layout(triangles_adjacency) in;
#endif
#ifdef WEIGHTED
layout(triangle_strip, max_vertices = 4) out;
#else
layout(triangle_strip, max_vertices = 4 * MAX_MULTIPLICITY) out;
#endif
#include "methods/silhouette/edge.glsl"

void main() {
    Edge edge = load_edge();
    if (edge.multiplicity == 0) return;
    vec4 a = clip_near(edge.a);
    vec4 b = clip_near(edge.b);
    vec4 a_far = clip_far(edge.a);
    vec4 b_far = clip_far(edge.b);
#ifdef WEIGHTED
    emit_side_quad(a, b, a_far, b_far, edge.multiplicity);
#else
    for (int i = abs(edge.multiplicity); i > 0; --i) {
        emit_side_quad(a, b, a_far, b_far, edge.multiplicity);
    }
#endif
}
