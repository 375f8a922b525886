// The side quads of one edge: |multiplicity| copies, wound after its sign.
//
// MAX_MULTIPLICITY: most opposite vertices that an edge may have.
#include "shared/extrude.glsl"
#include "methods/silhouette/edge.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 4 * MAX_MULTIPLICITY) out;
layout(location = 0) flat in uint number[];
// The position alone: every component of every vertex counts against the device's limit.
out gl_PerVertex {
    vec4 gl_Position;
};

void main() {
    uvec4 edge = edges[number[0]];
    vec3 a = positions[edge.x].xyz;
    vec3 b = positions[edge.y].xyz;
    int m = multiplicity(edge, a, b);
    if (m == 0) return;
    vec4 a_near = clip_near(a);
    vec4 b_near = clip_near(b);
    vec4 a_far = clip_far(a);
    vec4 b_far = clip_far(b);
    // With m > 0 the volume is on the left of a to b as the light sees it. Seen from outside,
    // a, a_far, b_far, b then is counter-clockwise. Both windings are cut along the same diagonal,
    // b to a_far, so that opposite copies cancel to the pixel.
    vec4 second = m > 0 ? a_far : b_near;
    vec4 third = m > 0 ? b_near : a_far;
    for (int i = abs(m); i > 0; --i) {
        gl_Position = a_near; EmitVertex();
        gl_Position = second; EmitVertex();
        gl_Position = third; EmitVertex();
        gl_Position = b_far; EmitVertex();
        EndPrimitive();
    }
}
