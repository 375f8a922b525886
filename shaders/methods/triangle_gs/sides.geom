// The three side quads of the shadow volume of one triangle, wound so that they look counter-clockwise
// from outside of the volume. The triangle's own winding plays no part.
#include "shared/extrude.glsl"
#include "shared/facing.glsl"
#include "methods/volumes/side_quad.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 12) out;
layout(location = 0) in vec3 position[];

void main() {
    int side = facing(position[0], position[1], position[2], frame.light);
    if (side == 0 || side < 0 && caster.light_facing_only != 0u) return;
    vec4 near[3];
    vec4 far[3];
    for (int i = 0; i < 3; ++i) {
        near[i] = clip_near(position[i]);
        far[i] = clip_far(position[i]);
    }
    // Facing the light, the triangle is on the left of each of its edges as the light sees it.
    for (int i = 0; i < 3; ++i) {
        int j = i == 2 ? 0 : i + 1;
        if (vertex_less(position[i], position[j])) {
            emit_side_quad(near[i], near[j], far[i], far[j], side);
        } else {
            emit_side_quad(near[j], near[i], far[j], far[i], -side);
        }
    }
}
