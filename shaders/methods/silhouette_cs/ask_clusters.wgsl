// Asks the edges of clusters whose planes may lie on both sides of the light's hyperplane, by the facings of their own
// triangles, and marks those with faces: see src/geometry/silhouette/clusters.rs.
#include "methods/silhouette/facing_by_positions.wgsl"
#include "methods/silhouette_cs/asked.wgsl"

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

@group(0) @binding(1) var<uniform> light: DualLight;
@group(1) @binding(0) var<storage, read> clusters: array<Cluster>;
// The edges of all clusters, 16 each: their numbers, and where they are marked.
@group(1) @binding(5) var<storage, read> cluster_edges: array<vec2<u32>>;
// A bit for each edge of a block.
@group(1) @binding(7) var<storage, read_write> marks: array<atomic<u32>>;

const EDGES: u32 = 16u;
// Where a cluster has fewer.
const NO_EDGE: u32 = 0xffffffffu;

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
    let first = EDGES * number;
    let end = min(first + EDGES, arrayLength(&cluster_edges));
    for (var place = first; place < end; place++) {
        let number = cluster_edges[place].x;
        if number == NO_EDGE {
            continue;
        }
        let edge = edges[number];
        end_a = positions[edge.x].xyz;
        end_b = positions[edge.y].xyz;
        let sums = multiplicities_of(edge);
        if any(sums != vec2<i32>(0)) {
            multiplicities[number] = pack(sums);
            let bit = cluster_edges[place].y;
            atomicOr(&marks[bit / 32u], 1u << (bit % 32u));
        }
    }
}
