// The facing of each case, as a tessellation control shader computes it.
#include "shared/facing.glsl"
#include "tests/facing_cases.glsl"

layout(vertices = 1) out;
layout(location = 0) flat in uint number[];

void main() {
    results[number[0]] = facing_of_case(number[0]);
    gl_TessLevelOuter[0] = 0.0;
    gl_TessLevelOuter[1] = 0.0;
    gl_TessLevelOuter[2] = 0.0;
    gl_TessLevelOuter[3] = 0.0;
}
