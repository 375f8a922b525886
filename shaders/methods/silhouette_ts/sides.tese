// Bends the row of quads into |m| side quads on top of each other (Milet et al. 2014, algorithm 5).
//
// Columns of the row alternate between far and near in pairs, and between a, b and b, a:
//   a_far  a  b  b_far  a_far  a ...     (row 0)
//   b_far  b  a  a_far  b_far  b ...     (row 1)
// so quads 0, 2, 4, ... are the side quad, all of one winding, and 1, 3, ... have no area. With m < 0, a
// and b change places, which turns the winding.
//
// How the tessellator cuts a quad in two, and with which vertex each half begins, is its own affair, and both
// matter to the last bits of depth: the corners of a side quad lie in one plane only but for rounding, and a
// rasteriser that takes the plane of a long thin triangle from its far end loses digits by cancellation. Those
// decide pixels beside the near edge, on the surface that the quad starts from. The middle row settles it: all its
// points fall on the same near corner, row 0's of column 1. With m > 0 what remains is the triangles
// b, a, b_far and a, a_far, b_far, and a tessellator that goes around the outline begins the first with b.
#include "shared/extrude.glsl"

layout(quads, equal_spacing, ccw) in;
layout(location = 0) patch in vec3 patch_a;
layout(location = 1) patch in vec3 patch_b;
layout(location = 2) patch in int patch_multiplicity;
#ifdef WEIGHTED
layout(location = 1) flat out int weight;
#endif

void main() {
#ifdef WEIGHTED
    weight = abs(patch_multiplicity);
    int quads = 1;
#else
    int quads = 2 * abs(patch_multiplicity) - 1;
#endif
    int column = int(gl_TessCoord.x * float(quads) + 0.5);
    bool in_middle = gl_TessCoord.y > 0.25 && gl_TessCoord.y < 0.75;
    bool in_row_1 = gl_TessCoord.y > 0.5;
    bool turned = (column & 2) == 2;
    bool at_far = ((column + 1) & 2) == 0;
    bool is_other_end = !in_middle && in_row_1 != turned;
    vec3 corner = is_other_end != (patch_multiplicity < 0) ? patch_b : patch_a;
    gl_Position = at_far ? clip_far(corner) : clip_near(corner);
}
