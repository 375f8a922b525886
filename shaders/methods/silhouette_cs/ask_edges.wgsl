// Asks the edges of the clusters that are listed, by the facings of their own triangles, and marks those with faces.
#include "methods/silhouette/facing_by_positions.wgsl"
#include "methods/silhouette_cs/asked.wgsl"
#include "methods/silhouette_cs/listed.wgsl"

// How many clusters, and their numbers.
@group(1) @binding(0) var<storage, read> listed: array<u32>;
// Of the edges, which are those of all clusters, 16 each: their numbers among all edges, and where they are marked.
@group(1) @binding(5) var<storage, read> places: array<vec2<u32>>;
// A bit for each edge of a block.
@group(1) @binding(7) var<storage, read_write> marks: array<atomic<u32>>;

fn ask(place: u32) {
    // Where a cluster has fewer, this one has no triangles.
    let edge = edges[place];
    end_a = positions[edge.x].xyz;
    end_b = positions[edge.y].xyz;
    let sums = multiplicities_of(edge);
    if any(sums != vec2<i32>(0)) {
        let number_and_bit = places[place];
        multiplicities[number_and_bit.x] = pack(sums);
        let bit = number_and_bit.y;
        atomicOr(&marks[bit / 32u], 1u << (bit % 32u));
    }
}

@compute @workgroup_size(WORKGROUP)
fn ask_edges(
    @builtin(global_invocation_id) at: vec3<u32>,
    @builtin(num_workgroups) workgroups: vec3<u32>,
) {
    let end = EDGES * listed[0];
    for (var i = at.x; i < end; i += WORKGROUP * workgroups.x) {
        ask(EDGES * listed[1u + i / EDGES] + i % EDGES);
    }
}
