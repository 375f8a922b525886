// Marks the edges of clusters whose planes may lie on both sides of the light's hyperplane: see
// src/geometry/silhouette/clusters.rs.

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

@group(1) @binding(0) var<storage, read> clusters: array<Cluster>;
// The bits of the edges of all clusters, 32 each.
@group(1) @binding(1) var<storage, read> bits: array<u32>;
@group(1) @binding(2) var<storage, read> light: DualLight;
@group(1) @binding(3) var<storage, read_write> marks: array<atomic<u32>>;

const EDGES: u32 = 32u;

@compute @workgroup_size(64)
fn mark_clusters(@builtin(global_invocation_id) at: vec3<u32>) {
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
    let first = EDGES * number;
    let end = min(first + EDGES, arrayLength(&bits));
    for (var edge = first; edge < end; edge++) {
        let bit = bits[edge];
        atomicOr(&marks[bit / 32u], 1u << (bit % 32u));
    }
}
