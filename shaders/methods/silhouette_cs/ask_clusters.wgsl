// Lists the clusters of edges whose planes may lie on both sides of the light's hyperplane: see
// src/geometry/silhouette/clusters.rs. In which order they are listed says nothing: each edge is marked in a place of its own.
#include "methods/silhouette_cs/listed.wgsl"

struct Cluster {
    low: vec4<f32>,
    high: vec4<f32>,
    doubt: vec2<f32>,
    unused: vec2<f32>,
}

struct DualLight {
    light: vec4<f32>,
    // What rounding grows with.
    size: vec2<f32>,
    unused: vec2<f32>,
}

@group(0) @binding(0) var<uniform> light: DualLight;
@group(1) @binding(0) var<storage, read> clusters: array<Cluster>;
// How many are listed, and which: see ask_edges.wgsl.
@group(1) @binding(1) var<storage, read_write> listed: array<atomic<u32>>;
// The workgroups that ask the edges of those.
@group(1) @binding(2) var<storage, read_write> workgroups: array<atomic<u32>, 4>;

// Every device takes so many at once.
const MOST_WORKGROUPS: u32 = 65535u;

@compute @workgroup_size(64)
fn ask_clusters(@builtin(global_invocation_id) at: vec3<u32>) {
    let number = at.x;
    if number >= arrayLength(&clusters) {
        return;
    }
    let cluster = clusters[number];
    // Two corners decide, picked by the signs of the light's components (Wallner 2006, section 2.1).
    let least = dot(light.light, select(cluster.high, cluster.low, light.light >= vec4<f32>(0.0)));
    let most = dot(light.light, select(cluster.low, cluster.high, light.light >= vec4<f32>(0.0)));
    let doubt = dot(cluster.doubt, light.size);
    if least > doubt || -most > doubt {
        return;
    }
    let place = atomicAdd(&listed[0], 1u);
    atomicStore(&listed[1u + place], number);
    atomicMax(&workgroups[0], min(place / (WORKGROUP / EDGES) + 1u, MOST_WORKGROUPS));
}
