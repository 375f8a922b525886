// Which side of a triangle the light is on. The twin of src/geometry/facing.rs, which says why it is
// done this way; the two agree bit for bit, so change both or neither.
//
// `precise` forbids the compiler to fuse, reorder or simplify. One operation a line, each in a precise
// variable of its own: nothing then depends on how far a compiler carries the qualifier.

// The vertex order: by x, then y, then z.
bool vertex_less(vec3 a, vec3 b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// The facing of a triangle whose vertices are in the vertex order.
int reference_facing(vec3 a, vec3 b, vec3 c, vec4 light) {
    // Rounding could give such a triangle a side, and the sort has no parity to go with it.
    if (a == b || b == c) return 0;

    precise vec3 x = c - a;
    precise vec3 scaled = a * light.w;
    precise vec3 y = light.xyz - scaled;
    precise vec3 e = b - a;
    precise vec3 left = x.yzx * y.zxy;
    precise vec3 right = x.zxy * y.yzx;
    precise vec3 n = left - right;
    precise vec3 terms = n * e;
    precise float xy = terms.x + terms.y;
    precise float d = xy + terms.z;

    int sign = 0; // a d that overflowed to NaN has no side
    if (d > 0.0) sign = 1;
    if (d < 0.0) sign = -1;
    return sign;
}

// The facing of a, b, opposite where a is before b in the vertex order.
int facing_of_edge(vec3 a, vec3 b, vec3 opposite, vec4 light) {
    // Sorting keeps the winding of a, b, opposite if the opposite vertex goes first or last.
    if (vertex_less(opposite, a)) return reference_facing(opposite, a, b, light);
    if (vertex_less(opposite, b)) return -reference_facing(a, opposite, b, light);
    return reference_facing(a, b, opposite, light);
}

// +1 if the light lies on the side from which a, b, c look counter-clockwise, -1 on the other side,
// 0 in the plane of the triangle or if two vertices are equal. light.w: 1 position, 0 direction towards
// the light. Vertices and light are multiples of 2^-40.
int facing(vec3 a, vec3 b, vec3 c, vec4 light) {
    if (vertex_less(b, a)) return -facing_of_edge(b, a, c, light);
    return facing_of_edge(a, b, c, light);
}
