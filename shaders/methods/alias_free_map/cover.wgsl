// Shadows what small triangles cover in the light's map, and leaves the tiles of large ones to `cover_parts`.
#include "shared/frame.wgsl"
#include "shared/pixels.wgsl"
#include "methods/alias_free_map/covered.wgsl"

// A triangle with no more cells is small.
const FEW_CELLS: u32 = 256u;

// All cells of a triangle from a first to a last.
fn darken_cells(face: u32, first: vec2<u32>, last: vec2<u32>, covered: Coverage, of_caster: Blocker) {
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            darken_cell(face, vec2<u32>(x, y), covered, of_caster);
        }
    }
}

fn cover_tiles(triangle: u32, face: u32, covered: Coverage, of_caster: Blocker) {
    let half = 0.5 * f32(TILE);
    for (var y = covered.first.y / TILE; y <= covered.last.y / TILE; y++) {
        for (var x = covered.first.x / TILE; x <= covered.last.x / TILE; x++) {
            let first = TILE * vec2<u32>(x, y);
            let tile = tile_index(face, vec2<u32>(x, y));
            let middle = vec2<f32>(first) - vec2<f32>(covered.first) + half;
            let reach = cells[tile * TILE_WORDS + TILE_END + REACH];
            if reach < covered.nearest || !is_covered(covered.edges, middle, half) {
                continue;
            }
            if !leave_part(Part(triangle, tile)) {
                let last = min(first + TILE - 1u, covered.last);
                darken_cells(face, max(first, covered.first), last, covered, of_caster);
            }
        }
    }
}

@compute @workgroup_size(64)
fn cover(@builtin(global_invocation_id) at: vec3<u32>, @builtin(num_workgroups) workgroups: vec3<u32>) {
    let triangle = invocation(at, workgroups);
    if triangle >= arrayLength(&casters) {
        return;
    }
    let caster = casters[triangle];
    let of_caster = blocker(caster, frame.light);
    if of_caster.side == 0.0 {
        return;
    }
    for (var face = 0u; face < face_count(); face++) {
        if ranges[face].x == 0u {
            continue;
        }
        let covered = coverage(caster, face);
        if covered.is_empty {
            continue;
        }
        let size = covered.last - covered.first + 1u;
        if size.x * size.y <= FEW_CELLS {
            darken_cells(face, covered.first, covered.last, covered, of_caster);
        } else {
            cover_tiles(triangle, face, covered, of_caster);
        }
    }
}
