// Edges with their opposite vertices, by number.
#include "methods/silhouette/multiplicity.glsl"

// x, y: end points. z, w: first opposite vertex and how many. Twin of `Edge` in src/geometry/topology.rs.
layout(set = 0, binding = 3, std430) readonly buffer Edges { uvec4 edges[]; };
layout(set = 0, binding = 4, std430) readonly buffer Opposites { uint opposites[]; };

Edge edge_of(uint number) {
    uvec4 record = edges[number];
    Edge edge = Edge(positions[record.x].xyz, positions[record.y].xyz, 0);
    for (uint i = 0u; i < record.w; ++i) {
        vec3 opposite = positions[opposites[record.z + i]].xyz;
        edge.multiplicity += of_casting(facing_of_edge(edge.a, edge.b, opposite, frame.light), int(i));
    }
    return edge;
}
