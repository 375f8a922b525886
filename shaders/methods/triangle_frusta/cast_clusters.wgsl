// Holds the shadow of each cluster of triangles against the trees of boxes, and leaves the blocks of tiles that it may meet
// to `cast_blocks`.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/triangle_frusta/frustum.wgsl"

struct Cluster {
    low: vec3<f32>,
    unused_low: u32,
    high: vec3<f32>,
    unused_high: u32,
    // Sum of its triangles' normals, which need not all point to the same side.
    normal: vec3<f32>,
    unused_normal: u32,
}

@group(2) @binding(8) var<storage, read> clusters: array<Cluster>;

// Which clusters cast: those that face the light, or the others.
override is_facing: bool;

// How much longer and earlier a ray may be for rounding.
const MARGIN: f32 = 1.0 / 1048576.0;

// Whether a ray to the light from somewhere in a node's box may meet that of a cluster.
//
// A ray from p to the light is in the box's slab along an axis from the time (near - p) / (light - p) to (far - p) / (light - p).
// Both only rise or only fall with p, so that the ends of the node's box are enough.
fn may_meet(node: Node, cluster: Cluster) -> bool {
    let light = frame.light;
    let node_low = node.centre.at - node.extent.half - scene_rounding;
    let node_high = node.centre.at + node.extent.half + scene_rounding;
    let from_low = light.xyz - node_low * light.w;
    let from_high = light.xyz - node_high * light.w;
    var enter = 0.0;
    var leave = select(1.0 + MARGIN, 3e38, light.w == 0.0);
    for (var axis = 0u; axis < 3u; axis++) {
        let low = from_low[axis];
        let high = from_high[axis];
        if low * high <= 0.0 || min(abs(low), abs(high)) < 1e-18 {
            // Some rays never leave the slab, or are never in it; all of them where they are parallel.
            let is_beside = node_high[axis] < cluster.low[axis] || node_low[axis] > cluster.high[axis];
            if light.w == 0.0 && is_beside {
                return false;
            }
            continue;
        }
        let near = select(cluster.high[axis], cluster.low[axis], low > 0.0);
        let far = select(cluster.low[axis], cluster.high[axis], low > 0.0);
        let enters = vec2<f32>((near - node_low[axis]) / low, (near - node_high[axis]) / high);
        let leaves = vec2<f32>((far - node_low[axis]) / low, (far - node_high[axis]) / high);
        let first = min(enters.x, enters.y);
        let last = max(leaves.x, leaves.y);
        enter = max(enter, first - MARGIN * (1.0 + abs(first)));
        leave = min(leave, last + MARGIN * (1.0 + abs(last)));
    }
    return enter <= leave;
}

// Whether most of it faces the light.
fn faces_light(cluster: Cluster) -> bool {
    let middle = 0.5 * (cluster.low + cluster.high);
    return dot(cluster.normal, frame.light.xyz - middle * frame.light.w) > 0.0;
}

fn cast_on_tree(number: u32, cluster: Cluster, tree: u32) {
    var node = 0u;
    loop {
        let box = Node(centres[tree + node], extents[tree + node]);
        var below = 0u;
        let is_lit = atomicLoad(&dark[tree + node]) == 0u;
        if is_lit && !is_empty(box) && may_meet(box, cluster) {
            if node < first_block() {
                below = 4u * node + 1u;
            } else if !leave_part(Part(number, tree + node)) {
                for (var lane = 0u; lane < CLUSTER; lane++) {
                    cast_triangle(CLUSTER * number + lane, tree + node);
                }
            }
        }
        if below != 0u {
            node = below;
            continue;
        }
        // After the last of four comes what follows the one above.
        while node != 0u && node % 4u == 0u {
            node = (node - 1u) / 4u;
        }
        if node == 0u {
            break;
        }
        node++;
    }
}

@compute @workgroup_size(64)
fn cast_clusters(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let number = invocation(at, workgroups);
    if number >= arrayLength(&clusters) || faces_light(clusters[number]) != is_facing {
        return;
    }
    for (var slice = 0u; slice < slices; slice++) {
        cast_on_tree(number, clusters[number], slice * tree_size());
    }
}
