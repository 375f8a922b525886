// A triangle's shadow frustum against boxes and samples. Needs shared/frame.wgsl and shared/pixels.wgsl.
#include "shared/view_sample.wgsl"
#include "shared/parts.wgsl"
#include "methods/triangle_frusta/tree.wgsl"

@group(2) @binding(1) var<storage, read> casters: array<Caster>;
@group(2) @binding(2) var<storage, read> corners: array<SampleCorner>;
@group(2) @binding(6) var<storage, read> ways: array<SampleWay>;
@group(2) @binding(3) var<storage, read> centres: array<NodeCentre>;
@group(2) @binding(7) var<storage, read> extents: array<NodeExtent>;
// Not 0 for nodes all of whose samples are in shadow.
@group(2) @binding(4) var<storage, read_write> dark: array<atomic<u32>>;

@group(2) @binding(5) var<storage, read> points: array<SamplePoint>;

// Triangles of a cluster: twin of `CLUSTER` in src/methods/triangle_frusta/clusters.rs.
const CLUSTER: u32 = 32u;

// Where a box lies to a frustum.
const OUTSIDE: u32 = 0u;
const ACROSS: u32 = 1u;
const INSIDE: u32 = 2u;

// The frustum of a triangle for tests with boxes. Beside its planes it has one at each corner, whose distance is the sum of
// those from the two light planes there, each by a scale: they cut off what these leave of a box at sharp corners.
struct Frustum {
    planes: Blocker,
    // Of the distances from `ab`, `ac` and `bc`.
    scales: vec3<f32>,
    at_a: vec3<f32>,
    at_b: vec3<f32>,
    at_c: vec3<f32>,
}

// By what a normal is about 1 long.
fn scale_of(normal: vec3<f32>) -> f32 {
    let size = abs(normal);
    return 1.0 / max(max(size.x, max(size.y, size.z)), 1e-37);
}

fn frustum_of(caster: Caster) -> Frustum {
    let planes = blocker(caster, frame.light);
    let scales = vec3<f32>(scale_of(planes.ab), scale_of(planes.ac), scale_of(planes.bc));
    let ab = scales.x * planes.ab;
    let ac = scales.y * planes.ac;
    let bc = scales.z * planes.bc;
    return Frustum(planes, scales, ab + ac, ab + bc, ac + bc);
}

// Where the box of a node lies.
fn side_of(node: Node, frustum: Frustum) -> u32 {
    let planes = frustum.planes;
    let from_a = node.centre.at - planes.a;
    let from_b = node.centre.at - planes.b;
    let half = node.extent.half;
    let about_a = with_room(from_a, half);
    let about_b = with_room(from_b, half);
    let ab = distances(planes.ab, from_a, about_a);
    let ac = distances(planes.ac, from_a, about_a);
    let bc = distances(planes.bc, from_b, about_b);
    let own = distances(planes.own, from_a, about_a);
    let scaled = frustum.scales * vec3<f32>(ab.x, ac.x, bc.x);
    // Where two normals nearly cancel, their distances round as before.
    let rounding = 2.0 * dot(max(about_a, about_b) - half, vec3<f32>(1.0));
    let at_a = scaled.x + scaled.y - dot(abs(frustum.at_a), half) - rounding;
    let at_b = scaled.x + scaled.z - dot(abs(frustum.at_b), half) - rounding;
    let at_c = scaled.y + scaled.z - dot(abs(frustum.at_c), half) - rounding;
    let least_beside = max(ab.x - ab.y, max(ac.x - ac.y, bc.x - bc.y));
    let least = max(max(least_beside, at_a), max(at_b, at_c));
    if least > 0.0 || own.x - own.y >= -planes.contact {
        return OUTSIDE;
    }
    let most = max(ab.x + ab.y, max(ac.x + ac.y, bc.x + bc.y));
    let contact = planes.contact + planes.double_area * node.centre.uncertainty;
    return select(ACROSS, INSIDE, most <= 0.0 && own.x + own.y < -contact);
}

fn darken_if_behind(pixel: u32, of_caster: Blocker) {
    if !may_be_behind(points[pixel].at, of_caster) || is_dark(pixel) {
        return;
    }
    let way = ways[pixel];
    if way.place != 0u && is_behind(sample_point(corners[pixel], way), of_caster, 0.0) {
        darken(pixel);
    }
}

fn cast_on_tile(tile: u32, of_caster: Blocker) {
    let corner = corner_of(tile);
    let end = min(corner + TILE, vec2<u32>(frame.picture.xy));
    for (var y = corner.y; y < end.y; y++) {
        for (var x = corner.x; x < end.x; x++) {
            darken_if_behind(pixel_at(vec2<u32>(x, y)), of_caster);
        }
    }
}

// Whether a triangle shadows a part of a node, as far as boxes tell.
fn is_cut(node: u32, frustum: Frustum) -> bool {
    if atomicLoad(&dark[node]) != 0u {
        return false;
    }
    let side = side_of(Node(centres[node], extents[node]), frustum);
    if side == INSIDE {
        atomicStore(&dark[node], 1u);
    }
    return side == ACROSS;
}

// What a triangle shadows in a block. Neighbours look at the same nodes at the same time.
fn cast_on_block(tree: u32, block: u32, frustum: Frustum) {
    if !is_cut(tree + block, frustum) {
        return;
    }
    for (var above = 4u * block + 1u; above <= 4u * block + 4u; above++) {
        if !is_cut(tree + above, frustum) {
            continue;
        }
        for (var tile = 4u * above + 1u; tile <= 4u * above + 4u; tile++) {
            if is_cut(tree + tile, frustum) {
                cast_on_tile(tile - first_tile(), frustum.planes);
            }
        }
    }
}

fn cast_triangle(triangle: u32, place: u32) {
    if triangle >= arrayLength(&casters) {
        return;
    }
    let frustum = frustum_of(casters[triangle]);
    let tree = place / tree_size() * tree_size();
    if frustum.planes.side != 0.0 {
        cast_on_block(tree, place - tree, frustum);
    }
}
