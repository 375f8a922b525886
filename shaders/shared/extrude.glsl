// From world to clip space, at a vertex and at infinity away from the light.
//
// All faces of all shadow volumes must meet without gaps, also where one pipeline draws one and
// another the other. So every face gets its corners from these two functions, `precise`: the same
// vertex has the same bits wherever it is computed.
#include "shared/frame.glsl"

vec4 to_clip(vec4 p) {
    precise vec4 xy = frame.view_projection[0] * p.x + frame.view_projection[1] * p.y;
    precise vec4 zw = frame.view_projection[2] * p.z + frame.view_projection[3] * p.w;
    precise vec4 clip = xy + zw;
    return clip;
}

// The vertex itself.
vec4 clip_near(vec3 p) {
    return to_clip(vec4(p, 1.0));
}

// The point at infinity where the ray from the light through the vertex ends. Its clip z is 0
// exactly, on the far plane: row z of the matrix is (0, 0, 0, near).
vec4 clip_far(vec3 p) {
    precise vec3 direction = p * frame.light.w - frame.light.xyz;
    return to_clip(vec4(direction, 0.0));
}
