// The multiplicity of an edge.
#include "shared/frame.glsl"
#include "shared/facing.glsl"
#include "shared/caster.glsl"

// End points, a before b in the vertex order. The multiplicity is the signed sum of the facings of the
// triangles on the edge, each taken as a, b, opposite vertex (Milet et al. 2014, algorithm 2). Where it is
// positive, the light sees the surface on the left of a to b; where it is 0, the edge is no silhouette.
struct Edge {
    vec3 a;
    vec3 b;
    int multiplicity;
};

// What a triangle adds to the multiplicity. Where only triangles that face the light cast, every second one goes from b to a.
int of_casting(int facing, int number) {
    if (caster.light_facing_only == 0u) return facing;
    return (number & 1) == 0 ? max(facing, 0) : min(facing, 0);
}
