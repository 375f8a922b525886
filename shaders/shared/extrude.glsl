// From world to clip space, at a vertex and at the far end of its shadow.
//
// All faces of all shadow volumes must meet without gaps, also where one pipeline draws one and
// another the other. So every face gets its corners from these two functions, `precise`: the same
// vertex has the same bits wherever it is computed.
#include "shared/frame.glsl"
#include "shared/caster.glsl"

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

// Where the ray from the light through the vertex ends: on the end plane of its object (geometry/end_plane.rs). On that at
// infinity it is on the far plane exactly: row z of the matrix is (0, 0, 0, near) or, with standard depth, row w less that.
vec4 clip_far(vec3 p) {
    vec4 plane = frame.end_planes[caster.end_plane];
    precise vec3 light_terms = plane.xyz * frame.light.xyz;
    precise float of_light = light_terms.x + light_terms.y + light_terms.z + plane.w * frame.light.w;
    precise vec3 terms = plane.xyz * p;
    precise float of_p = terms.x + terms.y + terms.z + plane.w;
    precise vec4 left = vec4(p, 1.0) * of_light;
    precise vec4 right = frame.light * of_p;
    precise vec4 end = left - right;
    return to_clip(end);
}
