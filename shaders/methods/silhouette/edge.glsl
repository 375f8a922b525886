// Edges with their opposite vertices, and the multiplicity of an edge.
//
// PATCH_OPPOSITES: where it is defined, an edge comes as a patch of vertices, its two end points and so
// many opposite vertices; the first end point stands for those that there are not, and adds nothing.
// Otherwise it comes as a number.
//
// To be included after the input layout of a geometry shader, which sizes the input arrays.
#include "methods/silhouette/multiplicity.glsl"

#ifdef PATCH_OPPOSITES

layout(location = 0) in vec3 position[];

Edge load_edge() {
    Edge edge = Edge(position[0], position[1], 0);
    for (int i = 2; i < 2 + PATCH_OPPOSITES; ++i) {
        edge.multiplicity += of_casting(facing_of_edge(edge.a, edge.b, position[i], frame.light), i - 2);
    }
    return edge;
}

#else
#include "methods/silhouette/edge_records.glsl"

layout(location = 0) flat in uint number[];

Edge load_edge() {
    return edge_of(number[0]);
}

#endif
