// A corner of a face by its number: first those of the side quads that edges may have, six each, of silhouettes and then of
// open edges; then those of front caps, three a triangle, and of back caps. A face that is not there has no area.
#include "shared/extrude.wgsl"
#include "methods/silhouette/multiplicity.wgsl"
#include "methods/silhouette/facing_by_positions.wgsl"

// Of each side quad its edge, and which of the edge's it is.
@group(1) @binding(0) var<storage, read> quads: array<vec2<u32>>;
@group(1) @binding(4) var<storage, read> indices: array<u32>;
// Whose each triangle is.
@group(1) @binding(5) var<storage, read> casters: array<u32>;

// The first quad of an open edge, the first corner of a front cap, and that of a back cap.
override first_open: u32;
override first_front: u32;
override first_back: u32;
// Whether an edge has one quad, which counts as often as its multiplicity says; else it has as many.
override weighted: bool;

struct Corner {
    @invariant @builtin(position) position: vec4<f32>,
    // How often the face counts.
    @location(0) @interpolate(flat) weight: f32,
}

fn corner_at(vertex: u32, is_far: bool, plan: Plan) -> vec4<f32> {
    if is_far {
        // Where far ends meet, all are that of one vertex.
        let p = positions[select(vertex, 0u, plan.far_ends_meet)].xyz;
        return clip_far(p, (plan.far >> 29u) - 1u);
    }
    return clip_near(positions[vertex].xyz);
}

fn no_corner() -> Corner {
    return Corner(vec4<f32>(0.0, 0.0, 0.0, 1.0), 0.0);
}

fn side_corner(number: u32, corner: u32) -> Corner {
    let quad = quads[number];
    let edge = edges[quad.x];
    let plan = plan_of(edge.w >> 15u);
    end_a = positions[edge.x].xyz;
    end_b = positions[edge.y].xyz;
    let sums = multiplicities_of(edge);
    let multiplicity = select(sums.x, sums.y, number >= first_open);
    let count = abs(multiplicity);
    if i32(quad.y) >= count || (plan.far_ends_meet && corner >= 3u) {
        return no_corner();
    }
    // a, far a, b and b, far a, far b; or wound the other way round, cut along the same diagonal: see src/methods/side_quad.rs.
    var other_way = array<u32, 6>(0u, 2u, 1u, 3u, 5u, 4u);
    let place = select(other_way[corner], corner, multiplicity > 0);
    let is_b = ((0x2cu >> place) & 1u) != 0u;
    let is_far = ((0x32u >> place) & 1u) != 0u;
    let position = corner_at(select(edge.x, edge.y, is_b), is_far, plan);
    return Corner(position, f32(select(1, count, weighted)));
}

fn cap_corner(number: u32, is_back: bool) -> Corner {
    let triangle = number / 3u;
    let plan = plan_of(casters[triangle]);
    let first = 3u * triangle;
    let a = positions[indices[first]].xyz;
    let b = positions[indices[first + 1u]].xyz;
    let c = positions[indices[first + 2u]].xyz;
    let side = facing(a, b, c, frame.light);
    if side == 0 || (side < 0 && plan.casting != ALL) {
        return no_corner();
    }
    // Counter-clockwise from outside: the front cap is seen from the light, the back cap from the other side.
    let corner = number % 3u;
    let is_turned = (side < 0) != is_back;
    let place = select(corner, (3u - corner) % 3u, is_turned);
    return Corner(corner_at(indices[first + place], is_back, plan), 1.0);
}

@vertex
fn face(@builtin(vertex_index) vertex: u32) -> Corner {
    if vertex < first_front {
        return side_corner(vertex / 6u, vertex % 6u);
    }
    if vertex < first_back {
        return cap_corner(vertex - first_front, false);
    }
    return cap_corner(vertex - first_back, true);
}
