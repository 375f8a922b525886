// Bends the row of quads into |m| side quads on top of each other (Milet et al. 2014, algorithm 5).
//
// Columns of the row alternate between near and far in pairs, and between a, b and b, a:
//   a  a_far  b_far  b  a  a_far ...     (row 0)
//   b  b_far  a_far  a  b  b_far ...     (row 1)
// so quads 0, 2, 4, ... are the side quad, all of one winding, and 1, 3, ... have no area.
#include "shared/extrude.glsl"

layout(quads, equal_spacing, cw) in;
layout(location = 0) patch in vec3 patch_a;
layout(location = 1) patch in vec3 patch_b;
layout(location = 2) patch in int patch_quads;

void main() {
    int column = int(gl_TessCoord.x * float(patch_quads) + 0.5);
    // Where the other inner level is above 1, the tessellator adds a middle row at 0.5. It falls on
    // row 0, so that what it cuts off has no area.
    int row = gl_TessCoord.y > 0.75 ? 1 : 0;
    bool at_b = ((row ^ (column >> 1)) & 1) == 1;
    bool at_far = ((column + 1) & 2) == 2;
    vec3 corner = at_b ? patch_b : patch_a;
    gl_Position = at_far ? clip_far(corner) : clip_near(corner);
}
