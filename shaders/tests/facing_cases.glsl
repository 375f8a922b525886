// Cases of four vectors each: the corners of a triangle, and the light.
layout(set = 0, binding = 0, std430) readonly buffer Cases { vec4 cases[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { int results[]; };

int facing_of_case(uint i) {
    return facing(cases[4 * i].xyz, cases[4 * i + 1].xyz, cases[4 * i + 2].xyz, cases[4 * i + 3]);
}
