// Edges with their opposite vertices, and the multiplicity of an edge.
//
// PATCH_OPPOSITES: where it is defined, an edge comes as a patch of vertices, its two end points and so
// many opposite vertices; the first end point stands for those that there are not, and adds nothing.
// Otherwise it comes as a number.
//
// To be included after the input layout of a geometry shader, which sizes the input arrays.
#include "shared/frame.glsl"
#include "shared/facing.glsl"
#include "shared/caster.glsl"

// End points, a before b in the vertex order. The multiplicity is the signed sum of the facings of the
// triangles on the edge, each taken as a, b, opposite vertex (Milet et al. 2014, algorithm 2). Where it is
// positive, the light sees the surface on the left of a to b; where it is 0, the edge is no silhouette.
struct Edge {
    vec3 a;
    vec3 b;
    int multiplicity;
};

// What a triangle adds to the multiplicity. Where only triangles that face the light cast, every second one goes from b to a.
int of_casting(int facing, int number) {
    if (caster.light_facing_only == 0u) return facing;
    return (number & 1) == 0 ? max(facing, 0) : min(facing, 0);
}

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

layout(location = 0) flat in uint number[];

// x, y: end points. z, w: first opposite vertex and how many. Twin of `Edge` in src/geometry/topology.rs.
layout(set = 0, binding = 3, std430) readonly buffer Edges { uvec4 edges[]; };
layout(set = 0, binding = 4, std430) readonly buffer Opposites { uint opposites[]; };

Edge load_edge() {
    uvec4 record = edges[number[0]];
    Edge edge = Edge(positions[record.x].xyz, positions[record.y].xyz, 0);
    for (uint i = 0u; i < record.w; ++i) {
        vec3 opposite = positions[opposites[record.z + i]].xyz;
        edge.multiplicity += of_casting(facing_of_edge(edge.a, edge.b, opposite, frame.light), int(i));
    }
    return edge;
}

#endif
