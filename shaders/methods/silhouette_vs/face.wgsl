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

// Which corner of the scene's volumes that is.
struct Place {
    vertex: u32,
    is_far: bool,
    caster: u32,
    // 0 if there is none.
    weight: i32,
}

const NOWHERE: Place = Place(0u, false, 0u, 0);

fn place_of_side(number: u32, corner: u32) -> Place {
    let quad = quads[number];
    let edge = edges[quad.x];
    let caster = edge.w >> 15u;
    end_a = positions[edge.x].xyz;
    end_b = positions[edge.y].xyz;
    let sums = multiplicities_of(edge);
    let multiplicity = select(sums.x, sums.y, number >= first_open);
    let count = abs(multiplicity);
    if i32(quad.y) >= count || (corner >= 3u && plan_of(caster).far_ends_meet) {
        return NOWHERE;
    }
    // a, far a, b and b, far a, far b; or wound the other way round, cut along the same diagonal: see src/methods/side_quad.rs.
    // Bit i is that of corner i.
    let is_left = multiplicity > 0;
    let is_b = ((select(0x1au, 0x2cu, is_left) >> corner) & 1u) != 0u;
    let is_far = ((select(0x34u, 0x32u, is_left) >> corner) & 1u) != 0u;
    return Place(select(edge.x, edge.y, is_b), is_far, caster, select(1, count, weighted));
}

fn place_of_cap(number: u32, is_back: bool) -> Place {
    let triangle = number / 3u;
    let caster = casters[triangle];
    let first = 3u * triangle;
    let a = positions[indices[first]].xyz;
    let b = positions[indices[first + 1u]].xyz;
    let c = positions[indices[first + 2u]].xyz;
    let side = facing(a, b, c, frame.light);
    if side == 0 || (side < 0 && plan_of(caster).casting != ALL) {
        return NOWHERE;
    }
    // Counter-clockwise from outside: the front cap is seen from the light, the back cap from the other side.
    let corner = number % 3u;
    let is_turned = (side < 0) != is_back;
    return Place(indices[first + select(corner, (3u - corner) % 3u, is_turned)], is_back, caster, 1);
}

fn place_of(number: u32) -> Place {
    if number < first_front {
        return place_of_side(number / 6u, number % 6u);
    }
    let is_back = number >= first_back;
    return place_of_cap(number - select(first_front, first_back, is_back), is_back);
}

// All corners are projected here, so the same corner has the same bits in all faces.
@vertex
fn face(@builtin(vertex_index) number: u32) -> Corner {
    let place = place_of(number);
    if place.weight == 0 {
        return Corner(vec4<f32>(0.0, 0.0, 0.0, 1.0), 0.0);
    }
    let plan = plan_of(place.caster);
    // Where far ends meet, all are that of one vertex.
    let p = positions[select(place.vertex, 0u, place.is_far && plan.far_ends_meet)].xyz;
    if place.is_far {
        return Corner(clip_far(p, (plan.far >> 29u) - 1u), f32(place.weight));
    }
    return Corner(clip_near(p), f32(place.weight));
}
