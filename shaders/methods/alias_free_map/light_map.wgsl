// The map of a light: a cube's six faces about a lamp, one face across the direction of a light at infinity, each cut to the
// samples that it holds and divided into cells. Tiles of 32 × 32 cells come one after another in memory.
#include "shared/first_look.wgsl"

// Cells along a face.
override resolution: u32;
// Whether the samples of a cell are next to each other, or linked.
override is_sorted: bool;

const TILE: u32 = 32u;
const TILE_CELLS: u32 = TILE * TILE;
// Words of a cell: where its list begins, and how far from the light its samples reach, by `ordered`.
const CELL_WORDS: u32 = 2u;
// Words of a tile: those of its cells, where the last list ends if they are sorted, and how far all samples reach.
const TILE_WORDS: u32 = CELL_WORDS * TILE_CELLS + 2u;
const TILE_END: u32 = CELL_WORDS * TILE_CELLS;
const REACH: u32 = 1u;

// So small a part of a coordinate is no longer told apart by cells.
const LEAST_PART: f32 = 1.0 / 131072.0;

fn face_count() -> u32 {
    return select(6u, 1u, frame.light.w == 0.0);
}

// Coordinates are relative to it.
fn origin() -> vec3<f32> {
    return select(frame.light.xyz, frame.eye.xyz, frame.light.w == 0.0);
}

// x and y on a face, times w, and w: 1 for a light at infinity, else the distance from the lamp across the face.
fn on_face(from_origin: vec3<f32>, face: u32) -> vec3<f32> {
    if frame.light.w == 0.0 {
        let towards = normalize(frame.light.xyz);
        let other = select(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), abs(towards.x) > 0.6);
        let right = normalize(cross(towards, other));
        return vec3<f32>(dot(right, from_origin), dot(cross(right, towards), from_origin), 1.0);
    }
    let sign = select(1.0, -1.0, (face & 1u) != 0u);
    switch face / 2u {
        case 0u: { return vec3<f32>(from_origin.yz, sign * from_origin.x); }
        case 1u: { return vec3<f32>(from_origin.zx, sign * from_origin.y); }
        default: { return vec3<f32>(from_origin.xy, sign * from_origin.z); }
    }
}

// Where that is on the face. A sample may be where the lamp is.
fn place_on_face(on_its_face: vec3<f32>) -> vec2<f32> {
    return on_its_face.xy / max(on_its_face.z, 1e-37);
}

// On which face a point lies.
fn face_of(from_origin: vec3<f32>) -> u32 {
    if frame.light.w == 0.0 {
        return 0u;
    }
    let size = abs(from_origin);
    if size.x >= max(size.y, size.z) {
        return select(0u, 1u, from_origin.x < 0.0);
    }
    if size.y >= size.z {
        return select(2u, 3u, from_origin.y < 0.0);
    }
    return select(4u, 5u, from_origin.z < 0.0);
}

// Numbers above 0 in the order of floats.
fn ordered(value: f32) -> u32 {
    let bits = bitcast<u32>(value);
    return select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

fn in_float(number: u32) -> f32 {
    return bitcast<f32>(select(~number, number & 0x7fffffffu, (number & 0x80000000u) != 0u));
}

// What samples a face holds: the largest of -x, -y, x and y, by `ordered`; 0 where there are none.
alias Range = vec4<u32>;

// A face as it is cut and divided.
struct Face {
    low: vec2<f32>,
    high: vec2<f32>,
    // How many to a unit.
    cells: vec2<f32>,
}

fn face_from(range: Range) -> Face {
    let low = -vec2<f32>(in_float(range.x), in_float(range.y));
    let high = vec2<f32>(in_float(range.z), in_float(range.w));
    let least = LEAST_PART * max(max(abs(low), abs(high)), vec2<f32>(1e-20));
    let side = max((high - low) / f32(resolution), least);
    return Face(low, high, 1.0 / side);
}

// How far a point is from the light, as far as it matters which of two on the same face is farther.
fn depth_of(from_origin: vec3<f32>, on_its_face: vec3<f32>) -> f32 {
    return select(on_its_face.z, -dot(normalize(frame.light.xyz), from_origin), frame.light.w == 0.0);
}

fn tile_index(face: u32, tile: vec2<u32>) -> u32 {
    let tiles = resolution / TILE;
    return (face * tiles + tile.y) * tiles + tile.x;
}

// The first word of a cell.
fn cell_index(face: u32, cell: vec2<u32>) -> u32 {
    let within = cell % TILE;
    return tile_index(face, cell / TILE) * TILE_WORDS + CELL_WORDS * (within.y * TILE + within.x);
}
