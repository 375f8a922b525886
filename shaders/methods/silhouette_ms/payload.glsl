// What a task hands to its mesh workgroups: the silhouette edges of a cluster of EDGES.

struct Silhouette {
    uint count;
    uint edges[EDGES];
    // Signed; see methods/silhouette/multiplicity.glsl.
    int multiplicities[EDGES];
};

taskPayloadSharedEXT Silhouette silhouette;

// Side quads of a mesh workgroup.
const uint QUADS = 32;
