// A triangle's shadow frustum against boxes and samples. Needs shared/frame.wgsl and shared/pixels.wgsl.
#include "shared/blocks.wgsl"
#include "shared/view_sample.wgsl"
#include "shared/parts.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(1) var<storage, read> casters: array<Caster>;
@group(2) @binding(2) var<storage, read> samples: array<ViewSample>;
@group(2) @binding(3) var<storage, read> nodes: array<Node>;
// Not 0 for nodes all of whose samples are in shadow.
@group(2) @binding(4) var<storage, read_write> dark: array<atomic<u32>>;

// Where a box lies to a frustum.
const OUTSIDE: u32 = 0u;
const ACROSS: u32 = 1u;
const INSIDE: u32 = 2u;

// What rounding may do to a distance, as a part of its terms.
const DISTANCE_ROUNDING: f32 = 1.0 / 2097152.0;

// The smallest and the largest distance of a box from a plane with this normal; both corners relative to a point of the plane.
fn distances(normal: vec3<f32>, low: vec3<f32>, high: vec3<f32>) -> vec2<f32> {
    let at_low = normal * low;
    let at_high = normal * high;
    let least = min(at_low, at_high);
    let most = max(at_low, at_high);
    let terms = max(abs(at_low), abs(at_high));
    let rounding = DISTANCE_ROUNDING * (terms.x + terms.y + terms.z);
    return vec2<f32>(least.x + least.y + least.z - rounding, most.x + most.y + most.z + rounding);
}

fn side_of(node: Node, of_caster: Blocker) -> u32 {
    if node.low.x > node.high.x {
        return OUTSIDE;
    }
    let low_a = node.low - of_caster.a;
    let high_a = node.high - of_caster.a;
    let ab = distances(of_caster.ab, low_a, high_a);
    let ac = distances(of_caster.ac, low_a, high_a);
    let bc = distances(of_caster.bc, node.low - of_caster.b, node.high - of_caster.b);
    let own = distances(of_caster.own, low_a, high_a);
    if max(ab.x, max(ac.x, bc.x)) > 0.0 || own.x >= -of_caster.contact {
        return OUTSIDE;
    }
    let contact = of_caster.contact + of_caster.double_area * node.uncertainty;
    return select(ACROSS, INSIDE, max(ab.y, max(ac.y, bc.y)) <= 0.0 && own.y < -contact);
}

fn darken_if_behind(pixel: u32, of_caster: Blocker) {
    let sample = samples[pixel];
    if sample.place != 0u && !is_dark(pixel) && is_behind(point_of(sample), of_caster, 0.0) {
        darken(pixel);
    }
}
