// The side quads of a triangle's shadow volume that those of its neighbours do not cancel (Stich, Wächter and Keller 2007,
// example 11-1): along the edges beyond which there is no triangle, or one that the light sees from the other side.
//
// A triangle that faces away has the volume of the same triangle turned around.
#include "shared/extrude.glsl"
#include "shared/facing.glsl"
#include "methods/volumes/side_quad.glsl"

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 12) out;
// The triangle's own at 0, 2 and 4, each followed by the neighbour's beyond the edge to the next.
layout(location = 0) in vec4 corner[];

void main() {
    int side = facing(corner[0].xyz, corner[2].xyz, corner[4].xyz, frame.light);
    if (side == 0 || side < 0 && caster.light_facing_only != 0u) return;
    for (int i = 0; i < 6; i += 2) {
        vec4 beyond = corner[i + 1];
        vec3 a = corner[i].xyz;
        vec3 b = corner[i == 4 ? 0 : i + 2].xyz;
        if (beyond.w != 0.0 && facing(a, beyond.xyz, b, frame.light) == side) continue;
        // Facing the light, the triangle is on the left of each of its edges as the light sees it.
        int winding = side;
        if (vertex_less(b, a)) {
            vec3 t = a;
            a = b;
            b = t;
            winding = -winding;
        }
        emit_side_quad(clip_near(a), clip_near(b), clip_far(a), clip_far(b), winding);
    }
}
