// Clusters of EDGES edges by the planes of their triangles: twin of src/geometry/silhouette/clusters.rs.

// A box in four dimensions around the planes of a cluster's edges.
struct Cluster {
    vec4 low;
    vec4 high;
    // What rounding grows by, with the light's place and with its w.
    vec2 doubt;
    vec2 unused;
};

layout(set = 0, binding = 5, std430) readonly buffer Clusters { Cluster clusters[]; };
// Of all clusters.
layout(set = 0, binding = 6, std430) readonly buffer ClusterEdges { uint cluster_edges[]; };
layout(set = 0, binding = 7, std430) readonly buffer DualLight {
    vec4 light;
    vec2 size;
    vec2 unused;
} dual;

const uint NO_EDGE = 0xffffffffu;

// Whether the light may have planes of the cluster on both sides. Two corners of the box decide, picked by the signs of the
// light's components (Wallner 2006, section 2.1).
bool may_have_silhouette(Cluster cluster) {
    bvec4 is_positive = greaterThanEqual(dual.light, vec4(0.0));
    float least = dot(dual.light, mix(cluster.high, cluster.low, is_positive));
    float most = dot(dual.light, mix(cluster.low, cluster.high, is_positive));
    float doubt = dot(cluster.doubt, dual.size);
    // What is not a number is asked, too.
    return !(least > doubt || -most > doubt);
}
