// What a fragment of a face adds to a count.
//
// OUTSIDE_ADDS: 1 if a face that is seen from outside of its volume adds, 0 if it takes away; not defined where the stencil
// counts by its tests.
// WEIGHTED: the last stage before the rasteriser says how often the face counts.
// IN_STENCIL: the count is the stencil's, which this reads and writes. Else it is blended.
#ifdef OUTSIDE_ADDS
#ifdef IN_STENCIL
#extension GL_ARB_shader_stencil_export : require
#endif

#ifdef WEIGHTED
layout(location = 1) flat in int weight;
#else
const int weight = 1;
#endif

int added() {
    return gl_FrontFacing == (OUTSIDE_ADDS == 1) ? weight : -weight;
}

#ifdef IN_STENCIL

// Twin of STENCIL_BINDING in src/gpu/native/bindings.rs.
layout(input_attachment_index = 0, set = 0, binding = 16) uniform usubpassInput stencil;

// Behind the constants of the caster.
layout(push_constant) uniform Counter {
    layout(offset = 16) uint modulus;
} counter;

void count() {
    // A multiple of the modulus keeps the sum above 0: no face counts more than 65,535 times.
    uint sum = (counter.modulus << 16) + subpassLoad(stencil).x + uint(added());
    gl_FragStencilRefARB = int(sum % counter.modulus);
}

#else

layout(location = 0) out float counted;

void count() {
    counted = float(added());
}

#endif
#endif
