// What a fragment of a face adds to a count that is blended.
//
// OUTSIDE_ADDS: 1 if a face that is seen from outside of its volume adds, 0 if it takes away; not defined where the stencil counts.
// WEIGHTED: the last stage before the rasteriser says how often the face counts.
#ifdef OUTSIDE_ADDS

#ifdef WEIGHTED
layout(location = 1) flat in int weight;
#else
const int weight = 1;
#endif
layout(location = 0) out float counted;

void count() {
    counted = float(gl_FrontFacing == (OUTSIDE_ADDS == 1) ? weight : -weight);
}

#endif
