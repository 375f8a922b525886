// Edges with their opposite vertices, and the multiplicity of an edge.
#include "shared/frame.glsl"
#include "shared/facing.glsl"

// x, y: end points, x before y in the vertex order. z, w: first opposite vertex and how many.
// Twin of `Edge` in src/geometry/topology.rs.
layout(set = 0, binding = 3, std430) readonly buffer Edges { uvec4 edges[]; };
layout(set = 0, binding = 4, std430) readonly buffer Opposites { uint opposites[]; };

// Signed sum of the facings of the triangles on edge a, b, each taken as a, b, opposite vertex
// (Milet et al. 2014, algorithm 2). Where it is positive, the light sees the surface on the left of
// a to b; where it is 0, the edge is no silhouette.
int multiplicity(uvec4 edge, vec3 a, vec3 b) {
    int sum = 0;
    for (uint i = 0u; i < edge.w; ++i) {
        sum += facing_of_edge(a, b, positions[opposites[edge.z + i]].xyz, frame.light);
    }
    return sum;
}
