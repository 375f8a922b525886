// What both tessellation control shaders begin with: the triangle as the evaluation shaders take it.
#include "shared/frame.glsl"
#include "shared/facing.glsl"
#include "shared/caster.glsl"

layout(vertices = 1) out;
layout(location = 0) in vec3 position[];
// Wound so that they look counter-clockwise from the light.
layout(location = 0) patch out vec3 corners[3];

// Hands the corners on. False if the triangle has no volume: it is edge-on to the light, or does not cast.
bool hand_on_corners() {
    int side = facing(position[0], position[1], position[2], frame.light);
    corners[0] = position[0];
    corners[1] = side < 0 ? position[2] : position[1];
    corners[2] = side < 0 ? position[1] : position[2];
    return side > 0 || side < 0 && caster.light_facing_only == 0u;
}
