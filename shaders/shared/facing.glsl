#ifndef SVBENCH_FACING_GLSL
#define SVBENCH_FACING_GLSL

// Which side of a triangle the light is on. The twin of src/geometry/facing.rs, which says why it is
// done this way; the two agree bit for bit, so change both or neither.
//
// Every result goes through flush(), so that a device that has no denormals gets the same bits as one
// that has. `precise` forbids the compiler to fuse, reorder or simplify. One operation a line, each in a
// precise variable of its own: nothing then depends on how far a compiler carries the qualifier.

const float FACING_FLUSH_BELOW = 7.52316384526264e-37; // 2^-120

float flush(float r) {
    return abs(r) < FACING_FLUSH_BELOW ? 0.0 : r;
}

vec3 flush(vec3 r) {
    return vec3(flush(r.x), flush(r.y), flush(r.z));
}

float facing_product(float a, float b) {
    precise float r = a * b;
    return flush(r);
}

float facing_sum(float a, float b) {
    precise float r = a + b;
    return flush(r);
}

float facing_difference(float a, float b) {
    precise float r = a - b;
    return flush(r);
}

// The vertex order: by x, then y, then z.
bool vertex_less(vec3 a, vec3 b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// +1 if the light lies on the side from which a, b, c look counter-clockwise, -1 on the other side,
// 0 in the plane of the triangle or if two vertices are equal. light.w: 1 position, 0 direction towards
// the light. Vertices and light hold no denormals.
int facing(vec3 a, vec3 b, vec3 c, vec4 light) {
    bool swapped = false;
    vec3 t;
    if (vertex_less(b, a)) { t = a; a = b; b = t; swapped = !swapped; }
    if (vertex_less(c, b)) { t = b; b = c; c = t; swapped = !swapped; }
    if (vertex_less(b, a)) { t = a; a = b; b = t; swapped = !swapped; }
    // Rounding could give such a triangle a side, and the sort has no parity to go with it.
    if (a == b || b == c) return 0;

    precise vec3 x_raw = c - a;
    precise vec3 x = flush(x_raw);
    precise vec3 scaled_raw = a * light.w;
    precise vec3 scaled = flush(scaled_raw);
    precise vec3 y_raw = light.xyz - scaled;
    precise vec3 y = flush(y_raw);
    precise vec3 e_raw = b - a;
    precise vec3 e = flush(e_raw);

    precise float nx = facing_difference(facing_product(x.y, y.z), facing_product(x.z, y.y));
    precise float ny = facing_difference(facing_product(x.z, y.x), facing_product(x.x, y.z));
    precise float nz = facing_difference(facing_product(x.x, y.y), facing_product(x.y, y.x));
    precise float dxy = facing_sum(facing_product(nx, e.x), facing_product(ny, e.y));
    precise float d = facing_sum(dxy, facing_product(nz, e.z));

    int sorted = 0; // a d that overflowed to NaN has no side
    if (d > 0.0) sorted = 1;
    if (d < 0.0) sorted = -1;
    return swapped ? -sorted : sorted;
}

#endif
