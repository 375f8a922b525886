// Side quads and back cap of the shadow volume of one triangle, or at inner level 1 its front cap (Milet
// et al. 2014, algorithm 1).
//
// The tessellator makes a ring between the triangle and a smaller one inside of it. The points of the
// smaller one go to the far ends of the shadow: it becomes the back cap, the ring the side quads.
#include "shared/extrude.glsl"

// The front cap is wound as the given triangle, counter-clockwise as the light sees it. Sides and back cap
// are a cup that has its inside towards the light, so they are wound the other way round. Vulkan's domain is
// upside down, which makes `cw` the word for keeping the winding.
#if INNER_LEVEL == 1
layout(triangles, equal_spacing, cw) in;
#else
layout(triangles, equal_spacing, ccw) in;
#endif
layout(location = 0) patch in vec3 corners[3];

void main() {
    vec3 at = gl_TessCoord;
    vec3 nearest = at.x > at.y && at.x > at.z ? corners[0] : at.y > at.z ? corners[1] : corners[2];
    bool is_corner = max(max(at.x, at.y), at.z) > 0.99;
    gl_Position = is_corner ? clip_near(nearest) : clip_far(nearest);
}
