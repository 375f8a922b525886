// Edges of a cluster: twin of EDGES_A_CLUSTER in src/methods/silhouette_cs/kernels.rs.
const EDGES: u32 = 16u;
// Invocations of a workgroup that asks the edges of clusters.
const WORKGROUP: u32 = 64u;
