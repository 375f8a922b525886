// Emits the side quad of one edge from a geometry shader.
//
// The corners of a side quad lie in one plane only but for rounding, so the diagonal along which it is
// cut matters to the last bit of depth. Both windings are cut along the same one, from the larger end of
// the edge to the far end of the smaller one, so that opposite copies cancel to the pixel.
//
// WEIGHTED: fragments count as often as a weight says.

// The position alone: every component of every vertex counts against the device's limit.
out gl_PerVertex {
    vec4 gl_Position;
};

#ifdef WEIGHTED
layout(location = 1) flat out int weight;
#endif

void emit_corner(vec4 position, int times) {
    gl_Position = position;
#ifdef WEIGHTED
    weight = times;
#endif
    EmitVertex();
}

// The edge from its smaller end a to its larger end b. Where the volume is on the left of a to b as the
// light sees it, a, a_far, b_far, b is counter-clockwise seen from outside; that is winding > 0. Its weight is that of winding.
void emit_side_quad(vec4 a, vec4 b, vec4 a_far, vec4 b_far, int winding) {
    int times = abs(winding);
    emit_corner(a, times);
    emit_corner(winding > 0 ? a_far : b, times);
    emit_corner(winding > 0 ? b : a_far, times);
    emit_corner(b_far, times);
    EndPrimitive();
}
