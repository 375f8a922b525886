// Front and back cap of the shadow volume of one triangle, both wound so that they look
// counter-clockwise from outside of the volume. The triangle's own winding plays no part.
#include "shared/extrude.glsl"
#include "shared/facing.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 6) out;
layout(location = 0) flat in uint number[];
// The position alone: every component of every vertex counts against the device's limit.
out gl_PerVertex {
    vec4 gl_Position;
};

void main() {
    uint first = 3u * number[0];
    vec3 a = positions[indices[first]].xyz;
    vec3 b = positions[indices[first + 1u]].xyz;
    vec3 c = positions[indices[first + 2u]].xyz;
    int side = facing(a, b, c, frame.light);
    if (side == 0 || side < 0 && caster.light_facing_only != 0u) return;
    if (side < 0) {
        vec3 t = b;
        b = c;
        c = t;
    }
    // The front cap is seen from the light, so is the triangle; the back cap from the other side.
    gl_Position = clip_near(a); EmitVertex();
    gl_Position = clip_near(b); EmitVertex();
    gl_Position = clip_near(c); EmitVertex();
    EndPrimitive();
    gl_Position = clip_far(a); EmitVertex();
    gl_Position = clip_far(c); EmitVertex();
    gl_Position = clip_far(b); EmitVertex();
    EndPrimitive();
}
