// A corner of a side quad by its number: twice that of the vertex, and one more for the far end of its shadow.
#include "shared/extrude.glsl"

void main() {
    vec3 p = positions[gl_VertexIndex >> 1].xyz;
    gl_Position = (gl_VertexIndex & 1) == 0 ? clip_near(p) : clip_far(p);
}
