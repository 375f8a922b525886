// Needs shared/frame.wgsl and shared/pixels.wgsl. Which cells a triangle may cover, seen from the light; and what it shadows in them.
//
// Edges are lines in homogeneous coordinates (Olano and Greer 1997), so that a triangle that reaches behind the lamp needs no
// clipping. A cell is covered unless it lies wholly beyond an edge: each edge is moved out by half a cell (Hasselgren,
// Akenine-Möller and Ohlsson 2005) and by what rounding may do.

#include "shared/view_sample.wgsl"
#include "shared/parts.wgsl"
#include "methods/alias_free_map/light_map.wgsl"

@group(2) @binding(1) var<storage, read> casters: array<Caster>;
@group(2) @binding(2) var<storage, read> corners: array<SampleCorner>;
@group(2) @binding(6) var<storage, read> ways: array<SampleWay>;
@group(2) @binding(3) var<storage, read> ranges: array<Range>;
// Of each cell the first of its list, a pixel plus 1, or where it is in `points`; and how far it reaches.
@group(2) @binding(4) var<storage, read> cells: array<u32>;
// Points of samples, one a pixel, each with the next of its list, a pixel plus 1; or all lists one after another, each point
// with its pixel.
@group(2) @binding(5) var<storage, read> points: array<SamplePoint>;

// Cells by which an edge is moved out for rounding.
const MARGIN: f32 = 1.0 / 16.0;
const ROUNDING: f32 = 1.0 / 4194304.0;
const DEPTH_ROUNDING: f32 = 1.0 / 65536.0;
// Nearer to the plane through the lamp along a face, a corner is taken to be behind it.
const LEAST_W: f32 = 1.0 / 1024.0;

struct Edges {
    // Not below 0, times a cell's middle and 1, where it may be covered.
    lines: mat3x3<f32>,
    // What else is added per cell of half a side.
    reach: vec3<f32>,
}

struct Coverage {
    is_empty: bool,
    // How near to the light it is, less what rounding may do, by `ordered`.
    nearest: u32,
    // The first and the last cell in either direction.
    first: vec2<u32>,
    last: vec2<u32>,
    // With the first cell at 0.
    edges: Edges,
}

// What rounding may do to an edge's value at cells up to `end`.
fn edge_error(p: vec3<f32>, q: vec3<f32>, end: f32) -> f32 {
    let terms = abs(p.yzx * q.zxy) + abs(p.zxy * q.yzx);
    return ROUNDING * dot(terms, vec3<f32>(end, end, 1.0));
}

fn reach_of(line: vec3<f32>) -> f32 {
    return abs(line.x) + abs(line.y);
}

fn edges_of(p: vec3<f32>, q: vec3<f32>, r: vec3<f32>, end: f32) -> Edges {
    var lines = mat3x3<f32>(cross(q, r), cross(r, p), cross(p, q));
    let size = dot(p, lines[0]);
    let terms = abs(q.yzx * r.zxy) + abs(q.zxy * r.yzx);
    if abs(size) <= ROUNDING * dot(abs(p), terms) {
        // Edge-on: either side may be the inner one.
        return Edges(mat3x3<f32>(), vec3<f32>(0.0));
    }
    lines *= sign(size);
    let reach = vec3<f32>(reach_of(lines[0]), reach_of(lines[1]), reach_of(lines[2]));
    let most = MARGIN * max(reach.x, max(reach.y, reach.z));
    let errors = vec3<f32>(edge_error(q, r, end), edge_error(r, p, end), edge_error(p, q, end));
    let out = vec3<f32>(most) + errors;
    lines[0].z += out.x;
    lines[1].z += out.y;
    lines[2].z += out.z;
    return Edges(lines, reach);
}

// Whether a square about a middle, so many cells to either side, may be covered.
fn is_covered(edges: Edges, middle: vec2<f32>, half: f32) -> bool {
    let value = vec3<f32>(middle, 1.0) * edges.lines + half * edges.reach;
    return min(value.x, min(value.y, value.z)) >= 0.0;
}

// Whether none of it is on the face.
fn is_beside(face: Face, p: vec3<f32>, q: vec3<f32>, r: vec3<f32>) -> bool {
    // A cell more to each side.
    let low = face.low - 1.0 / face.cells;
    let high = face.high + 1.0 / face.cells;
    let above_low = max(p.xy - low * p.z, max(q.xy - low * q.z, r.xy - low * r.z));
    let below_high = min(p.xy - high * p.z, min(q.xy - high * q.z, r.xy - high * r.z));
    let is_behind = max(p.z, max(q.z, r.z)) <= 0.0;
    return is_behind || any(above_low < vec2<f32>(0.0)) || any(below_high > vec2<f32>(0.0));
}

// Of the depths of its corners; w on the face, and the largest coordinate there, of which rounding is a part.
fn nearest_of(caster: Caster, w: vec3<f32>, size: f32) -> u32 {
    var depth = w;
    if frame.light.w == 0.0 {
        let towards = normalize(frame.light.xyz);
        let from_origin = mat3x3<f32>(caster.a.xyz - origin(), caster.b.xyz - origin(), caster.c.xyz - origin());
        depth = -(towards * from_origin);
    }
    let most = max(size, max(abs(depth.x), max(abs(depth.y), abs(depth.z))));
    return ordered(min(depth.x, min(depth.y, depth.z)) - DEPTH_ROUNDING * most);
}

fn in_cells(face: Face, p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>((p.xy - face.low * p.z) * face.cells, p.z);
}

fn coverage(caster: Caster, face_number: u32) -> Coverage {
    var covered: Coverage;
    covered.is_empty = true;
    let face = face_from(ranges[face_number]);
    var p = on_face(caster.a.xyz - origin(), face_number);
    var q = on_face(caster.b.xyz - origin(), face_number);
    var r = on_face(caster.c.xyz - origin(), face_number);
    if is_beside(face, p, q, r) {
        return covered;
    }
    let sizes = max(abs(p), max(abs(q), abs(r)));
    let size = max(sizes.x, max(sizes.y, sizes.z));
    covered.nearest = nearest_of(caster, vec3<f32>(p.z, q.z, r.z), size);
    let is_before = min(p.z, min(q.z, r.z)) > LEAST_W * size;
    p = in_cells(face, p);
    q = in_cells(face, q);
    r = in_cells(face, r);
    let end = vec2<f32>(f32(resolution));
    let last = end - 1.0;
    covered.last = vec2<u32>(last);
    if is_before || frame.light.w == 0.0 {
        p = vec3<f32>(p.xy / p.z, 1.0);
        q = vec3<f32>(q.xy / q.z, 1.0);
        r = vec3<f32>(r.xy / r.z, 1.0);
        let low = min(p.xy, min(q.xy, r.xy)) - MARGIN;
        let high = max(p.xy, max(q.xy, r.xy)) + MARGIN;
        if any(high < vec2<f32>(0.0)) || any(low > end) {
            return covered;
        }
        covered.first = vec2<u32>(clamp(low, vec2<f32>(0.0), last));
        covered.last = vec2<u32>(clamp(high, vec2<f32>(0.0), last));
        let start = vec3<f32>(vec2<f32>(covered.first), 0.0);
        p -= start;
        q -= start;
        r -= start;
    }
    let cells = vec2<f32>(covered.last - covered.first) + 1.0;
    covered.edges = edges_of(p, q, r, max(cells.x, cells.y));
    covered.is_empty = false;
    return covered;
}

fn darken_if_behind(pixel: u32, point: vec3<f32>, of_caster: Blocker) {
    let may_be = !is_dark(pixel) && may_be_behind(point, of_caster);
    if may_be && is_behind(sample_point(corners[pixel], ways[pixel]), of_caster, 0.0) {
        darken(pixel);
    }
}

fn darken_list(cell: u32, of_caster: Blocker) {
    if is_sorted {
        let end = cells[cell + CELL_WORDS];
        for (var at = cells[cell]; at < end; at++) {
            let point = points[at];
            darken_if_behind(point.word, point.at, of_caster);
        }
        return;
    }
    var at = cells[cell];
    while at != 0u {
        let point = points[at - 1u];
        darken_if_behind(at - 1u, point.at, of_caster);
        at = point.word;
    }
}

// What a triangle shadows in a cell.
fn darken_cell(face_number: u32, cell: vec2<u32>, covered: Coverage, of_caster: Blocker) {
    let index = cell_index(face_number, cell);
    let may_reach = cells[index + REACH] >= covered.nearest;
    if may_reach && is_covered(covered.edges, vec2<f32>(cell - covered.first) + 0.5, 0.5) {
        darken_list(index, of_caster);
    }
}
