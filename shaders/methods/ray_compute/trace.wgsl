// A shadow ray a pixel, through a tree with four boxes a node.
#include "shared/trace.wgsl"

// Twin of `Node` in src/geometry/rays/tree.rs.
struct Node {
    low_x: vec4<f32>,
    low_y: vec4<f32>,
    low_z: vec4<f32>,
    high_x: vec4<f32>,
    high_y: vec4<f32>,
    high_z: vec4<f32>,
    children: vec4<u32>,
}

@group(2) @binding(2) var<storage, read> nodes: array<Node>;
@group(2) @binding(3) var<storage, read> casters: array<Caster>;

// The deepest trees that are followed; twin of `STACK` in src/methods/ray_compute.rs.
const STACK: u32 = 64u;

const LEAF: u32 = 1u << 31u;
const FIRST_BITS: u32 = 28u;

// Boxes that touch a slab's border must not meet 0 × ∞: directions are at least so far from 0 that a coordinate by them is
// finite.
const LEAST_DIRECTION: f32 = 1e-28;

fn is_leaf_blocking(child: u32, point: SurfacePoint) -> bool {
    let first = child & ((1u << FIRST_BITS) - 1u);
    let end = first + (child >> FIRST_BITS & 7u) + 1u;
    for (var i = first; i < end; i++) {
        if blocks(casters[i], frame.light, point, 0.0) {
            return true;
        }
    }
    return false;
}

fn is_blocked(point: SurfacePoint) -> bool {
    let place = point.corner + point.way;
    let towards = frame.light.xyz - place * frame.light.w;
    let away_from_0 = select(vec3<f32>(LEAST_DIRECTION), -vec3<f32>(LEAST_DIRECTION), towards < vec3<f32>(0.0));
    let inverse = 1.0 / select(towards, away_from_0, abs(towards) < vec3<f32>(LEAST_DIRECTION));
    let start = place * inverse;
    let end = select(1.0, 3e38, frame.light.w == 0.0);
    var waiting: array<u32, STACK>;
    waiting[0] = 0u;
    var count = 1u;
    while count > 0u {
        count--;
        let node = nodes[waiting[count]];
        let x_0 = node.low_x * inverse.x - start.x;
        let x_1 = node.high_x * inverse.x - start.x;
        let y_0 = node.low_y * inverse.y - start.y;
        let y_1 = node.high_y * inverse.y - start.y;
        let z_0 = node.low_z * inverse.z - start.z;
        let z_1 = node.high_z * inverse.z - start.z;
        let enter = max(max(min(x_0, x_1), min(y_0, y_1)), max(min(z_0, z_1), vec4<f32>(0.0)));
        let leave = min(min(max(x_0, x_1), max(y_0, y_1)), min(max(z_0, z_1), vec4<f32>(end)));
        let meets = enter <= leave;
        for (var slot = 0u; slot < 4u; slot++) {
            let child = node.children[slot];
            if child == 0u {
                break;
            }
            if !meets[slot] {
                continue;
            }
            if (child & LEAF) == 0u {
                waiting[count] = child;
                count++;
            } else if is_leaf_blocking(child, point) {
                return true;
            }
        }
    }
    return false;
}
