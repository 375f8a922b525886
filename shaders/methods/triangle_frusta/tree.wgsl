// Boxes around what a picture shows: of tiles of 4 × 4 pixels, four of them in each one above, up to one for the whole
// picture. Node 0 is that one; those of node n are 4n + 1 to 4n + 4. There is such a tree for each slice of depth.
#include "shared/first_look.wgsl"

// Tiles along a side of the square that the lowest nodes make up: a power of 2.
override tiles: u32;
// Trees.
override slices: u32;

const TILE: u32 = 4u;
// Tiles along a side of a block, which is two levels above.
const BLOCK_TILES: u32 = 4u;
const SLICES_PER_OCTAVE: f32 = 2.0;
const MOST_SLICES: u32 = 16u;

// A box, in two arrays as samples are.
struct Node {
    centre: NodeCentre,
    extent: NodeExtent,
}

struct NodeCentre {
    at: vec3<f32>,
    // The largest of any sample.
    uncertainty: f32,
}

struct NodeExtent {
    // Half its sides; far below 0 where there is nothing, so that it is outside of everything.
    half: vec3<f32>,
    unused: u32,
}

// What rounding moves a corner by, as a part of its coordinates.
const OF_BOX: f32 = 1.0 / 4194304.0;
const NO_EXTENT: f32 = -1e30;

fn is_empty(node: Node) -> bool {
    return node.extent.half.x < 0.0;
}

fn node_of(low: vec3<f32>, high: vec3<f32>, uncertainty: f32) -> Node {
    if low.x > high.x {
        return Node(NodeCentre(vec3<f32>(0.0), 0.0), NodeExtent(vec3<f32>(NO_EXTENT), 0u));
    }
    let centre = 0.5 * (low + high);
    let rounding = OF_BOX * (abs(low) + abs(high));
    let half = max(high - centre, centre - low) + rounding;
    return Node(NodeCentre(centre, uncertainty), NodeExtent(half, 0u));
}

// The first of the lowest nodes of a tree, of which there are tiles² of 4 / 3 tiles² in all.
fn first_tile() -> u32 {
    return (tiles * tiles - 1u) / 3u;
}

// The first of the blocks.
fn first_block() -> u32 {
    let blocks = tiles / BLOCK_TILES;
    return (blocks * blocks - 1u) / 3u;
}

fn tree_size() -> u32 {
    return first_tile() + tiles * tiles;
}

// Every other bit.
fn even_bits(bits: u32) -> u32 {
    var x = bits & 0x55555555u;
    x = (x | x >> 1u) & 0x33333333u;
    x = (x | x >> 2u) & 0x0f0f0f0fu;
    x = (x | x >> 4u) & 0x00ff00ffu;
    return (x | x >> 8u) & 0x0000ffffu;
}

// The first pixel of the lowest node of this number among them.
fn corner_of(number: u32) -> vec2<u32> {
    return TILE * vec2<u32>(even_bits(number), even_bits(number >> 1u));
}

// The slice of depth that a point is in. There are only so many, and the first follows the last: a box may be larger for it.
fn slice_of(point: vec3<f32>) -> u32 {
    let distance = (frame.view_projection * vec4<f32>(point, 1.0)).w;
    return u32(max(64.0 + SLICES_PER_OCTAVE * log2(max(distance, 1e-9)), 0.0)) % slices;
}
