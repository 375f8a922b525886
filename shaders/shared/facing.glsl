// Which side of a triangle the light is on. The twin of src/geometry/facing.rs, which says why it is
// done this way; the two agree bit for bit, so change both or neither.
//
// DETERMINISM: how the edges of a triangle come to agree, see `Determinism` in facing.rs; 3 is that of methods/adjacency_gs.
//
// `precise` forbids the compiler to fuse, reorder or simplify. One operation a line, each in a precise
// variable of its own: nothing then depends on how far a compiler carries the qualifier.

#ifndef DETERMINISM
#define DETERMINISM 0
#endif

// The vertex order: by x, then y, then z.
bool vertex_less(vec3 a, vec3 b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// On which side of the light plane through a and c the point b lies: the facing of a, b, c.
int light_plane_side(vec3 a, vec3 c, vec3 b, vec4 light) {
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

    int side = 0; // a d that overflowed to NaN has no side
    if (d > 0.0) side = 1;
    if (d < 0.0) side = -1;
    return side;
}

// The facing of a triangle whose vertices are in the vertex order.
int sorted_facing(vec3 a, vec3 b, vec3 c, vec4 light) {
    // Rounding could give such a triangle a side, and the sort has no parity to go with it.
    if (a == b || b == c) return 0;
    int side = light_plane_side(a, c, b, light);
#if DETERMINISM == 1
    if (side != -light_plane_side(a, b, c, light)) return 0;
    if (side != -light_plane_side(b, c, a, light)) return 0;
#endif
    return side;
}

// The facing of a, b, opposite where a is before b in the vertex order.
int facing_of_edge(vec3 a, vec3 b, vec3 opposite, vec4 light) {
#if DETERMINISM == 2
    return -light_plane_side(a, b, opposite, light);
#else
    // Sorting keeps the winding of a, b, opposite if the opposite vertex goes first or last.
    if (vertex_less(opposite, a)) return sorted_facing(opposite, a, b, light);
    if (vertex_less(opposite, b)) return -sorted_facing(a, opposite, b, light);
    return sorted_facing(a, b, opposite, light);
#endif
}

#if DETERMINISM == 3
// Whether the light is above the plane of a triangle, as found at its corner a.
bool is_above(vec3 a, vec3 b, vec3 c, vec4 light) {
    precise vec3 e = b - a;
    precise vec3 x = c - a;
    precise vec3 left = e.yzx * x.zxy;
    precise vec3 right = e.zxy * x.yzx;
    precise vec3 normal = left - right;
    precise vec3 scaled = a * light.w;
    precise vec3 y = light.xyz - scaled;
    precise vec3 terms = normal * y;
    precise float xy = terms.x + terms.y;
    precise float d = xy + terms.z;
    return d > 0.0;
}
#endif

// +1 if the light lies on the side from which a, b, c look counter-clockwise, -1 on the other side,
// 0 in the plane of the triangle or if two vertices are equal. light.w: 1 position, 0 direction towards
// the light. Vertices and light are multiples of 2^-40.
int facing(vec3 a, vec3 b, vec3 c, vec4 light) {
#if DETERMINISM == 2
    return -light_plane_side(a, b, c, light);
#elif DETERMINISM == 3
    // Stich et al. 2007, section 11.3.2: the triangle is asked at each of its corners, whichever comes first, and faces the
    // light if any says so. Every other one faces away.
    bool faces = is_above(a, b, c, light) || is_above(b, c, a, light) || is_above(c, a, b, light);
    return faces ? 1 : -1;
#else
    if (vertex_less(b, a)) return -facing_of_edge(b, a, c, light);
    return facing_of_edge(a, b, c, light);
#endif
}
