// Side quads and back cap of the shadow volume of one triangle, or at inner level 1 its front cap (Milet
// et al. 2014, algorithm 1).
//
// The tessellator makes a ring between the triangle and a smaller one inside of it. The points of the
// smaller one go to the far ends of the shadow: it becomes the back cap, the ring the side quads.
//
// Neighbouring triangles share a side quad, in opposite windings, and its two copies cancel to the pixel
// only if both are cut in two along the same diagonal, and, since rounding depends on it, if the triangle
// at the near edge begins with the same vertex. A point in the middle of an inner edge sees to it: placed
// on the far end of the smaller end of the edge, it leaves the triangles smaller_far, smaller, larger (the
// tessellator begins with the inner point) and smaller_far, larger, larger_far.
#include "shared/extrude.glsl"
#include "shared/facing.glsl"

// The front cap is wound as the given triangle, counter-clockwise as the light sees it. Sides and back cap
// are a cup that has its inside towards the light, so they are wound the other way round. Vulkan's domain is
// upside down, which makes `cw` the word for keeping the winding.
#if INNER_LEVEL == 1
layout(triangles, equal_spacing, ccw) in;
#else
layout(triangles, equal_spacing, cw) in;
#endif
layout(location = 0) patch in vec3 corners[3];

vec3 smaller(vec3 a, vec3 b) {
    return vertex_less(a, b) ? a : b;
}

void main() {
    vec3 at = gl_TessCoord;
    vec3 nearest = at.x > at.y && at.x > at.z ? corners[0] : at.y > at.z ? corners[1] : corners[2];
    float most = max(max(at.x, at.y), at.z);
    float least = min(min(at.x, at.y), at.z);
    bool is_corner = most > 0.99;
    // What is left for the third coordinate; the centre of all may go to any far end.
    bool in_middle_of_edge = abs(1.0 - most - least - most) < 0.05 && most - least > 0.05;
    if (in_middle_of_edge) {
        vec3 a = at.x < at.y && at.x < at.z ? corners[1] : corners[0];
        vec3 b = at.z < at.x && at.z < at.y ? corners[1] : corners[2];
        nearest = smaller(a, b);
    }
    gl_Position = is_corner ? clip_near(nearest) : clip_far(nearest);
}
