// Twists a row of five quads into the shadow volume of the triangle a, b, c (Milet et al. 2014, figure 3).
//
// Columns of the row, and what lies between them:
//   row 1:  a_far   a    a    a_far   b_far   b
//   row 0:  b_far   b    c    c_far   c_far   c
//            side ab | front cap | side ca | back cap | side bc
#include "shared/extrude.glsl"

layout(quads, fractional_odd_spacing, cw) in;
layout(location = 0) patch in vec3 corners[3];
#ifdef PUSH_FRONT_CAP
// 0 at near points, 1 at far ones: constant 0 on the front cap, and nowhere else.
layout(location = 0) out float farness;
#endif

// Corners in each column, of row 1 and of row 0.
const ivec2 ROWS[6] = ivec2[](
    ivec2(0, 1), ivec2(0, 1), ivec2(0, 2), ivec2(0, 2), ivec2(1, 2), ivec2(1, 2));

void main() {
    int column = int(gl_TessCoord.x * 5.0 + 0.5);
    bool at_far = column == 0 || column == 3 || column == 4;
    vec3 corner = corners[gl_TessCoord.y > 0.5 ? ROWS[column].x : ROWS[column].y];
    gl_Position = at_far ? clip_far(corner) : clip_near(corner);
#ifdef PUSH_FRONT_CAP
    farness = at_far ? 1.0 : 0.0;
#endif
}
