// Bends the row of quads into |m| side quads on top of each other (Milet et al. 2014, algorithm 5).
//
// Columns of the row alternate between near and far in pairs, and between a, b and b, a:
//   a  a_far  b_far  b  a  a_far ...     (row 0)
//   b  b_far  a_far  a  b  b_far ...     (row 1)
// so quads 0, 2, 4, ... are the side quad, all of one winding, and 1, 3, ... have no area. With m < 0, a
// and b change places, which turns the winding.
//
// How the tessellator cuts a quad in two is its own affair, and the corners of a side quad lie in one
// plane only but for rounding: cut differently, copies of a quad would differ in the last bit of depth.
// The middle row settles it. Its points fall on a_far in far columns and on b in near ones, so whatever
// the tessellator does, what remains is the triangles a, a_far, b and b, a_far, b_far.
#include "shared/extrude.glsl"

layout(quads, equal_spacing, cw) in;
layout(location = 0) patch in vec3 patch_a;
layout(location = 1) patch in vec3 patch_b;
layout(location = 2) patch in int patch_multiplicity;

void main() {
    int quads = 2 * abs(patch_multiplicity) - 1;
    int column = int(gl_TessCoord.x * float(quads) + 0.5);
    bool in_middle = gl_TessCoord.y > 0.25 && gl_TessCoord.y < 0.75;
    bool in_row_1 = gl_TessCoord.y > 0.5;
    bool turned = (column & 2) == 2;
    bool at_far = ((column + 1) & 2) == 2;
    bool at_b = in_middle ? !at_far : (in_row_1 != turned) != (patch_multiplicity < 0);
    vec3 corner = at_b ? patch_b : patch_a;
    gl_Position = at_far ? clip_far(corner) : clip_near(corner);
}
