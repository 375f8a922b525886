// The facing of each case, as a geometry shader computes it.
#include "shared/facing.glsl"
#include "tests/facing_cases.glsl"

layout(points) in;
layout(points, max_vertices = 1) out;
layout(location = 0) flat in uint number[];

void main() {
    results[number[0]] = facing_of_case(number[0]);
}
