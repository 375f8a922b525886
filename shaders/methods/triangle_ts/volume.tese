// Side quads and back cap of the shadow volume of one triangle, or at inner level 1 its front cap (Milet
// et al. 2014, algorithm 1).
//
// The tessellator makes a ring between the triangle and a smaller one inside of it. The points of the
// smaller one go to the far ends of the shadow: it becomes the back cap, the ring the side quads. The middle of an
// edge falls on one of its ends (see volume.tesc).
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
    bool on_outline = min(min(at.x, at.y), at.z) == 0.0;
    // The middle of an edge, where two coordinates are equal, goes to the edge's second end.
    bool at_1 = at.y > 0.25 && at.z < 0.25 || at.y > max(at.x, at.z);
    bool at_2 = at.z > 0.25 && at.x < 0.25 || at.z > max(at.x, at.y);
    vec3 corner = at_1 ? corners[1] : at_2 ? corners[2] : corners[0];
    gl_Position = on_outline ? clip_near(corner) : clip_far(corner);
}
